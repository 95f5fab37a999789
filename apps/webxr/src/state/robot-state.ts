/** What the robot has reported in this session. */
import type { RobotClient } from '@farpoint/operator';
import { nearView } from '../ground/near-field/near-view.ts';
import { alarmWords, raisedFirst } from '../words/alarm-words.ts';
import { motionWords, obstacleGuardWords, speedWords } from '../words/motion-words.ts';
import { readingsWithNavigation } from '../words/navigation-words.ts';
import type { Sampler } from './sampler.ts';

export type RobotState = ReturnType<typeof robotState>;

export function robotState({ link, stops, driver }: RobotClient, samples: Sampler) {
  return {
    /** `null` before the robot's welcome. */
    name: samples.of(() => link.session.welcome?.name ?? null),
    telemetry: samples.of(() => link.session.telemetry),
    readings: samples.of((atMs) => readingsWithNavigation(link.session, atMs)),
    /** The alarms that are raised, the worst first. */
    alarms: samples.of((atMs) =>
      [...link.session.alarms.values()]
        .sort(raisedFirst)
        .map((alarm) => alarmWords(alarm, link.silentMs(atMs))),
    ),
    /** Topics whose reports the dashboard shows component by component. */
    componentTopics: samples.of(() => link.session.components.list().map(({ topic }) => topic)),
    /** Who has a session; `null` if the robot does not say. */
    operators: samples.of(() => link.session.operators),
    estop: samples.of(() => link.session.estop),
    /**
     * What has become of this operator's STOP. Through a bridge the page itself says that it is latched, and numbers no
     * latches: then nothing is called confirmed.
     */
    stop: samples.of(() =>
      stops.status === 'confirmed' && link.session.estop.latch === undefined ? 'none' : stops.status,
    ),
    /** Why it does less than its driver asks for; `null` if it does not. */
    motion: samples.of(() => motionWords(link.session.telemetry?.motion)),
    /** That it does not look where it goes; `null` if it does, or does not say. */
    obstacleGuard: samples.of(() => {
      const guard = link.session.telemetry?.motion?.obstacleGuard;
      return guard === undefined || guard === 'on' ? null : obstacleGuardWords[guard];
    }),
    /** What is near it; `null` while nobody can tell. */
    near: samples.of((atMs) => nearView(link.session.near, atMs, link.session.clock.offsetMs)),
    /** Whether it is one that tells what is near it. */
    tellsNear: samples.of(
      () => link.phase === 'live' && link.session.telemetry?.motion?.obstacleGuard !== undefined,
    ),
    /** Which heights matter to it; `null` if it does not say. */
    heights: samples.of(() => link.session.welcome?.body?.heights ?? null),
    /** How fast it is, how fast it may go and why; `null` before it has said so. */
    speed: samples.of(() => {
      const { telemetry, welcome } = link.session;
      if (telemetry === null || welcome === null) return null;
      return speedWords(telemetry, welcome.limits.maxLinear, driver.stream.asked);
    }),
    /** The most that it drives, m/s. */
    maxLinear: samples.of(() => link.session.welcome?.limits.maxLinear ?? 0),
    /** There is a session, and the robot's emergency stop is on. */
    estopLatched: samples.of(() => link.phase === 'live' && link.session.estop.latched),
    /** It is, and it can be released at the robot only. */
    estopAtRobot: samples.of(
      () => link.phase === 'live' && link.session.estop.latched && link.session.estop.releasedAt === 'robot',
    ),
  };
}
