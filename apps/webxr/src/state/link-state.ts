/** The link: the state of the signaling service, the robots it lists, the chosen robot, and the session with it. */
import { type RobotClient, type RobotLink, robotAfter } from '@farpoint/operator';
import { computed } from '@preact/signals-core';
import type { SignalingFault } from '../ground/settings.ts';
import { type Silence, silenceOf } from '../ground/silence.ts';
import { obstacleOf } from '../words/access-words.ts';
import { type Banner, bannerWords } from '../words/banner-words.ts';
import { linkWords, signalingFaultWords, type Words } from '../words/words.ts';
import { type Sampler, steady } from './sampler.ts';
import type { Takeover } from './takeover.ts';

export type LinkState = ReturnType<typeof linkState>;

/** For how long the robot has said nothing; `lost` without a session. @param atMs page's clock */
export function robotSilence(link: Pick<RobotLink, 'phase' | 'silentMs'>, atMs: number): Silence {
  return link.phase === 'live' ? silenceOf(link.silentMs(atMs)) : 'lost';
}

/** Whether something has come from the robot just now: otherwise nothing of it is live. @param atMs page's clock */
export function isRobotHeard(link: Pick<RobotLink, 'phase' | 'silentMs'>, atMs: number): boolean {
  return robotSilence(link, atMs) === 'heard';
}

export interface LinkStateParts {
  readonly client: RobotClient;
  readonly samples: Sampler;
  /** The signaling service's, for people. */
  readonly host: string;
  readonly takeover: Takeover;
  /** Why the given signaling address cannot be used; `null` if it can. */
  readonly signalingFault: SignalingFault | null;
  /** Whether the browser believes that it has a network. */
  isOnline(): boolean;
}

export function linkState({ client, samples, host, takeover, signalingFault, isOnline }: LinkStateParts) {
  const { link } = client;
  const silence = samples.of((atMs) => robotSilence(link, atMs));
  const phase = samples.of(() => link.phase);
  const robots = samples.of(() => link.robots);
  const chosenRobotId = samples.of(() => client.chosenRobotId);
  const signInUrl = samples.of(() => link.signInUrl);
  return {
    /** The signaling service's host, for people. */
    host,
    robots,
    /** What robots tell about themselves without a session, while the list is looked at. */
    statuses: samples.of(() => link.statusFeed.statuses),
    /** Where operators sign in for a grant; `null` if the signaling service names no place. */
    signInUrl,
    chosenRobotId,
    /** A robot is chosen. The page connects to it whenever possible. */
    connected: computed(() => phase.value !== 'none'),
    /** The state of the connection to the signaling service. */
    signaling: samples.of(() => link.signaling),
    /** A session is established. */
    live: computed(() => phase.value === 'live'),
    silence,
    /** Something has come from the robot just now: otherwise no figure of it is live. */
    heard: computed(() => silence.value === 'heard'),
    /** The robot after the chosen one in the list; `null` if there is no other. */
    nextRobot: computed(() => robotAfter(robots.value, chosenRobotId.value)),
    /** What keeps the page from connecting until the operator does something; `null` if nothing does. */
    obstacle: samples.of(() =>
      link.phase === 'waiting' && link.robotListed
        ? obstacleOf(link.lastLoss, link.lossDetail, link.changedRobotKey, link.signInUrl)
        : null,
    ),
    /** What stands in the middle of the screen; `null` while there is nothing to say. */
    banner: steady(samples.of((atMs) => bannerOf(client, { atMs, takeover, isOnline }))),
    /** The state of the link in one line. */
    line: samples.of((atMs) => lineOf(client, signalingFault, atMs)),
  };
}

function bannerOf(
  { link, driver, chosenRobotId }: RobotClient,
  { atMs, takeover, isOnline }: { atMs: number; takeover: Takeover; isOnline: () => boolean },
): Banner | null {
  return bannerWords({
    phase: link.phase,
    silence: robotSilence(link, atMs),
    interrupted: link.interrupted,
    signaling: link.signaling,
    online: isOnline(),
    robotListed: link.robotListed,
    robotId: chosenRobotId,
    lastLoss: link.lastLoss,
    maxOperators: link.maxOperators,
    lossDetail: link.lossDetail,
    gripped: driver.isGripped,
    // A hand that holds on after it has handed the drive over has agreed to that.
    gripLost: takeover.isDisplaced(driver.isGripped) ? null : driver.lost,
    takenOverBy: takeover.by(driver.isGripped),
  });
}

function lineOf(
  { link, pointsAtMs }: RobotClient,
  signalingFault: SignalingFault | null,
  atMs: number,
): Words {
  if (signalingFault !== null && link.phase === 'none')
    return { text: signalingFaultWords(signalingFault), tone: 'bad' };
  const { grantEndsAtMs, telemetry, about } = link.session;
  return linkWords({
    phase: link.phase,
    signaling: link.signaling,
    robotListed: link.robotListed,
    lastLoss: link.lastLoss,
    maxOperators: link.maxOperators,
    lossDetail: link.lossDetail,
    grantLeftMs: grantEndsAtMs === null ? null : grantEndsAtMs - atMs,
    silentMs: link.silentMs(atMs),
    silence: robotSilence(link, atMs),
    pointsSilentMs: atMs - pointsAtMs,
    plays: about?.shows === 'files',
    rateByReports: telemetry?.stream.feedback === 'reports',
  });
}
