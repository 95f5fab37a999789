/** What the robot has reported in this session. */
import type { RobotClient } from '@farpoint/operator';
import { nearView } from '../ground/near-field/near-view.ts';
import { arePointsHeard } from '../ground/silence.ts';
import { inputSettings } from '../take/drive/stored-inputs.ts';
import { alarmWords, raisedFirst } from '../words/alarm-words.ts';
import { latchedStop } from '../words/estop-words.ts';
import { driverWords, listedNameWords } from '../words/handover-words.ts';
import { withChosenSpeed } from '../words/input-words.ts';
import { motionWords, obstacleGuardWords, speedWords } from '../words/motion-words.ts';
import { readingsWithNavigation } from '../words/navigation-words.ts';
import { isRobotHeard } from './link-state.ts';
import { type Sampler, steady } from './sampler.ts';

export type RobotState = ReturnType<typeof robotState>;

/** Whether points come as they should. @param atMs page's clock */
export function comesPoints(
  { link, pointsAtMs }: Pick<RobotClient, 'link' | 'pointsAtMs'>,
  atMs: number,
): boolean {
  const { telemetry } = link.session;
  return arePointsHeard(atMs - pointsAtMs, telemetry?.stream.framesPerSecond ?? 0);
}

export function robotState(client: RobotClient, samples: Sampler) {
  const { link, driver } = client;
  /** What is true only while the robot says it. */
  const whileHeard = <T>(read: (atMs: number) => T) =>
    samples.of((atMs) => (isRobotHeard(link, atMs) ? read(atMs) : null));
  return {
    /** Whether points come as they should: otherwise no figure of them is live. */
    pointsHeard: samples.of((atMs) => comesPoints(client, atMs)),
    ...aboutState(client, samples),
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
    ...estopState(client, samples),
    /** Why it does less than its driver asks for; `null` if it does not, or is not heard. */
    motion: whileHeard(() => motionWords(link.session.telemetry?.motion)),
    /** That it does not look where it goes; `null` if it does, or does not say. */
    obstacleGuard: whileHeard(() => {
      const guard = link.session.telemetry?.motion?.obstacleGuard;
      return guard === undefined || guard === 'on' ? null : obstacleGuardWords(guard);
    }),
    /** What is near it; `null` while nobody can tell. */
    near: samples.of((atMs) =>
      nearView(link.session.near, {
        nowMs: atMs,
        offsetMs: link.session.clock.offsetMs,
        heard: isRobotHeard(link, atMs),
      }),
    ),
    /** Whether it is one that tells what is near it. */
    tellsNear: samples.of(
      () => link.phase === 'live' && link.session.telemetry?.motion?.obstacleGuard !== undefined,
    ),
    /** Which heights matter to it; `null` if it does not say. */
    heights: samples.of(() => link.session.welcome?.body?.heights ?? null),
    /** How fast it is, how fast it may go and why; `null` before it has said so, and while it is not heard. */
    speed: whileHeard(() => {
      const { telemetry, welcome } = link.session;
      if (telemetry === null || welcome === null) return null;
      const words = speedWords(telemetry, welcome.limits.maxLinear, driver.stream.asked);
      return withChosenSpeed(words, inputSettings.speed.share.peek());
    }),
    /** The most that it drives, m/s. */
    maxLinear: samples.of(() => link.session.welcome?.limits.maxLinear ?? 0),
    /** Whether its base goes sideways. */
    goesSideways: samples.of(() => (link.session.welcome?.limits.maxLateral ?? 0) > 0),
  };
}

/** What the robot is. */
function aboutState({ link }: RobotClient, samples: Sampler) {
  return {
    /** `null` before the robot's welcome. */
    name: samples.of(() => link.session.welcome?.name ?? null),
    /** Whether it plays files, and whether it records; `null` if it does not say. */
    about: steady(samples.of(() => (link.phase === 'live' ? link.session.about : null))),
    /** Whether it has anything that velocities move; one that does not say has. */
    drives: samples.of(() => link.session.about?.drives ?? true),
  };
}

/** The robot's emergency stop, and what has become of this operator's STOP. */
function estopState({ link, stops, driver }: RobotClient, samples: Sampler) {
  return {
    estop: samples.of(() => link.session.estop),
    /** Who or what has stopped it, and who may release that; `null` while it is not latched, and without a session. */
    latchedStop: steady(
      samples.of((atMs) => {
        if (link.phase !== 'live') return null;
        const { estop, estopCause, lease, welcome, operators } = link.session;
        const role = welcome?.access?.role ?? null;
        const pressedBy = estopCause?.pressedBy && listedNameWords(estopCause.pressedBy, operators);
        const cause = estopCause && { ...estopCause, pressedBy };
        const named = driverWords(lease, operators);
        const heard = isRobotHeard(link, atMs);
        return latchedStop({ estop, cause, holder: driver.holder, driver: named, role, heard });
      }),
    ),
    /**
     * What has become of this operator's STOP. Through a bridge the page itself says that it is latched, and numbers no
     * latches: then nothing is called confirmed.
     */
    stop: samples.of(() =>
      stops.status === 'confirmed' && link.session.estop.latch === undefined ? 'none' : stops.status,
    ),
    /** There is a session, and the robot's emergency stop is on. */
    estopLatched: samples.of(() => link.phase === 'live' && link.session.estop.latched),
    /** It is, and it can be released at the robot only. */
    estopAtRobot: samples.of(
      () => link.phase === 'live' && link.session.estop.latched && link.session.estop.releasedAt === 'robot',
    ),
  };
}
