/** The link: the state of the signaling service, the robots it lists, the chosen robot, and the session with it. */
import { type RobotClient, robotAfter } from '@farpoint/operator';
import { computed } from '@preact/signals-core';
import { obstacleOf } from '../status/access-words.ts';
import { bannerWords } from '../status/banner-words.ts';
import { linkWords, type Words } from '../status/words.ts';
import { ListedRobots } from './listed-robots.ts';
import type { Sampler } from './sampler.ts';
import { steady } from './steady.ts';
import { Takeover } from './takeover.ts';

export type LinkState = ReturnType<typeof linkState>;

/** @param signalingFault why the given signaling address cannot be used; `null` if it can */
export function linkState(client: RobotClient, samples: Sampler, signalingFault: string | null) {
  const { link } = client;
  const takeover = new Takeover();
  client.on('lease', ({ holder, driver = null }) => takeover.onLease(holder, driver));
  client.on('session', () => takeover.reset());
  // Nobody has taken what was given.
  client.on('handover', ({ ended }) => {
    if (ended === 'accepted' && client.driver.holder !== 'you') takeover.reset();
  });
  const phase = samples.of(() => link.phase);
  const robots = samples.of(() => link.robots);
  const listed = new ListedRobots();
  client.on('robots', (list) => listed.take(list));
  // The link forgets what was said with each attempt, and a full robot is asked again and again.
  let here: string | null = null;
  client.on('loss', (loss) => {
    here = loss === 'robot-full' ? link.lossDetail : null;
  });
  const ready = samples.of(() => link.signaling === 'ready');
  const chosenRobotId = samples.of(() => client.chosenRobotId);
  const signInUrl = samples.of(() => link.signInUrl);
  return {
    robots,
    /** What robots say about themselves, by id, while the list is looked at. */
    statuses: samples.of(() => link.statusFeed.statuses),
    /** Where operators sign in for a grant; `null` if the signaling service names no place. */
    signInUrl,
    chosenRobotId,
    /** The signaling service has let this page in. */
    ready,
    /** The chosen robot, if the service lists its robots and has never listed this one; `null` otherwise. */
    missingRobotId: computed(() => {
      const id = chosenRobotId.value;
      if (id === null || phase.value !== 'waiting' || !ready.value) return null;
      // Read again whenever the list changes.
      return robots.value.every((robot) => robot.id !== id) && listed.lacks(id) ? id : null;
    }),
    /** A robot is chosen. The page connects to it whenever possible. */
    connected: computed(() => phase.value !== 'none'),
    /** A session is established. */
    live: computed(() => phase.value === 'live'),
    /** The robot after the chosen one in the list; `null` if there is no other. */
    nextRobot: computed(() => robotAfter(robots.value, chosenRobotId.value)),
    /** What keeps the page from connecting until the operator does something; `null` if nothing does. */
    obstacle: samples.of(() =>
      link.phase === 'waiting' && link.robotListed
        ? obstacleOf(link.lastLoss, link.lossDetail, link.changedRobotKey, link.signInUrl)
        : null,
    ),
    /** What stands in the middle of the screen; `null` while there is nothing to say. */
    banner: steady(
      samples.of((atMs) =>
        bannerWords({
          ...{ phase: link.phase, robotListed: link.robotListed, lastLoss: link.lastLoss },
          ...{
            silentMs: link.silentMs(atMs),
            maxOperators: link.maxOperators,
            lossDetail: here ?? link.lossDetail,
          },
          gripped: client.driver.stream.held || client.driver.lost !== null,
          gripLost: client.driver.lost,
          takenOverBy: takeover.by(client.driver.isGripped),
        }),
      ),
    ),
    /** The state of the link in one line. */
    line: samples.of((atMs): Words => {
      if (signalingFault !== null && link.phase === 'none')
        return { text: `Signaling address: ${signalingFault}`, tone: 'bad' };
      return linkWords({
        ...{ phase: link.phase, signaling: link.signaling, robotListed: link.robotListed },
        ...{ lastLoss: link.lastLoss, maxOperators: link.maxOperators, here },
        grantLeftMs: link.session.grantEndsAtMs === null ? null : link.session.grantEndsAtMs - atMs,
        silentMs: link.silentMs(atMs),
        pointsSilentMs: atMs - client.pointsAtMs,
        rateByReports: link.session.telemetry?.stream.feedback === 'reports',
      });
    }),
  };
}
