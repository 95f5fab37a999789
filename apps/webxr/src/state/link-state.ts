/** The link: the state of the signaling service, the robots it lists, the chosen robot, and the session with it. */
import { type RobotClient, robotAfter } from '@farpoint/operator';
import { computed } from '@preact/signals-core';
import { obstacleOf } from '../words/access-words.ts';
import { linkWords, type Words } from '../words/words.ts';
import type { Sampler } from './sampler.ts';

export type LinkState = ReturnType<typeof linkState>;

/** @param signalingFault why the given signaling address cannot be used; `null` if it can */
export function linkState(client: RobotClient, samples: Sampler, signalingFault: string | null) {
  const { link } = client;
  const phase = samples.of(() => link.phase);
  const robots = samples.of(() => link.robots);
  const chosenRobotId = samples.of(() => client.chosenRobotId);
  const signInUrl = samples.of(() => link.signInUrl);
  return {
    robots,
    /** Where operators sign in for a grant; `null` if the signaling service names no place. */
    signInUrl,
    chosenRobotId,
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
    /** The state of the link in one line. */
    line: samples.of((atMs): Words => {
      if (signalingFault !== null && link.phase === 'none')
        return { text: `Signaling address: ${signalingFault}`, tone: 'bad' };
      return linkWords({
        phase: link.phase,
        signaling: link.signaling,
        robotListed: link.robotListed,
        lastLoss: link.lastLoss,
        maxOperators: link.maxOperators,
        lossDetail: link.lossDetail,
        grantLeftMs: link.session.grantEndsAtMs === null ? null : link.session.grantEndsAtMs - atMs,
        silentMs: link.silentMs(atMs),
        pointsSilentMs: atMs - client.pointsAtMs,
        rateByReports: link.session.telemetry?.stream.feedback === 'reports',
      });
    }),
  };
}
