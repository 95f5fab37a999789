/** All the texts with which the page describes a state, a refusal or a failure to people. */

import {
  finalLosses,
  type GripLoss,
  type SessionLoss,
  type SessionPhase,
  type SignalingState,
  type StopStatus,
} from '@farpoint/operator';
import {
  type CommandRejection,
  type DriveState,
  GRANT_ENDS_SOON_S,
  type LeaseState,
  type Role,
  type Telemetry,
} from '@farpoint/protocol';
import type { Silence } from '../ground/silence.ts';

/** How urgent a text is: its colour. */
export type Tone = 'good' | 'neutral' | 'warning' | 'bad';

export interface Words {
  text: string;
  tone: Tone;
}

export const driveWords: Record<DriveState, Words> = {
  driving: { text: 'Driving', tone: 'good' },
  idle: { text: 'Stationary', tone: 'neutral' },
  watchdog: { text: 'Stopped: no recent command', tone: 'warning' },
  estop: { text: 'Emergency stop', tone: 'bad' },
  blocked: { text: 'Blocked by an obstacle', tone: 'warning' },
};

/** What the robot does, and what it waits for. */
export function driveStateWords({ drive, motion }: Pick<Telemetry, 'drive' | 'motion'>): Words {
  const stands = drive === 'watchdog' || drive === 'idle';
  if (stands && motion?.letGoFirst === true)
    return { text: 'Stopped by a gap: let go, then drive', tone: 'warning' };
  return driveWords[drive];
}

/** What has become of STOP; `null` if there is nothing to say. */
export const stopWords: Record<StopStatus, Words | null> = {
  none: null,
  unconfirmed: { text: 'STOP not yet confirmed', tone: 'warning' },
  confirmed: { text: 'STOP confirmed', tone: 'good' },
  undelivered: { text: 'STOP never arrived', tone: 'bad' },
};

export const rejectionWords: Record<CommandRejection, string> = {
  malformed: 'The robot could not read a command.',
  'out-of-range': 'The robot refused a speed above its limits.',
  stale: 'Commands reach the robot too late. It stays stopped until the connection improves.',
  repeated: 'The robot refused a command that arrived out of order.',
  'not-permitted': 'Your grant lets you watch this robot, but not drive it.',
  'not-lease-holder': 'Someone else is driving this robot. Press Take over to drive it yourself.',
  'dead-man-released': 'The robot moves only while you hold the grip.',
  'let-go-first': 'The robot was stopped while you held the grip. Let go of it, then drive.',
  'no-wheels': 'The robot’s wheels take no commands. The reading “Wheels” says why.',
  'estop-latched': 'The emergency stop is on. Release it, let go of the grip, then drive.',
  'rate-limited': 'The robot receives more commands than it accepts.',
};

/** Why the robot refused a command. @param holder who may drive, as far as the page knows */
export function wordsOfRejection(reason: CommandRejection, holder: LeaseState['holder']): string {
  if (reason === 'not-lease-holder' && holder !== 'other')
    return 'Your turn to drive has ended: the robot had not heard from you. Let go of the grip, then drive.';
  return rejectionWords[reason];
}

export const signalingWords: Record<SignalingState, Words> = {
  connecting: { text: 'Connecting to the signaling service…', tone: 'neutral' },
  ready: { text: 'Signaling connected', tone: 'good' },
  waiting: { text: 'Cannot reach the signaling service. Trying again…', tone: 'warning' },
  refused: { text: 'The signaling service refused the token. Correct it in Settings.', tone: 'bad' },
  stopped: { text: 'Not connected to the signaling service', tone: 'neutral' },
};

const lossWords: Record<Exclude<SessionLoss, 'robot-full'>, string> = {
  'not-connected': 'Could not connect to the robot. Trying again…',
  'connection-failed': 'The connection to the robot was lost. The robot stops automatically. Trying again…',
  'closed-by-robot': 'The robot ended the session. Trying again…',
  'robot-restarted': 'The robot has restarted. Reconnecting…',
  'robot-stopped': 'The robot was shut down. Waiting for it to come back…',
  'robot-left': 'The robot went offline while connecting. Trying again…',
  'bad-answer':
    'The robot cannot use the connection that this browser offers. Update the browser or use another. Trying again…',
  'not-granted': 'The robot admits only operators with a grant that is valid for it.',
  'robot-key-changed': 'The robot’s key has changed: it may be another robot.',
  'robot-unproven': 'The robot did not prove that it is the one that this browser knows.',
  'grant-expired': 'Your grant for this robot has ended. Ask for another.',
  'grant-revoked': 'Your grant for this robot has been revoked.',
  'ended-by-supervisor': 'A supervisor has ended your session. Choose the robot to connect again.',
  'unproven-peer':
    'The robot refused the connection: it is not encrypted end to end with this page. Trying again…',
  'not-reading': 'This page could not keep up with the robot’s messages. Reconnecting…',
  unheard: 'The robot had not heard from this page for too long. Reconnecting…',
  silent: 'The robot does not respond. Trying again…',
  'signaling-lost': 'The signaling service was lost while connecting. Trying again…',
  refused: 'The signaling service did not open a session. Trying again…',
};

export interface DrivingFacts {
  /** Whether the robot is heard and hears, in a session: otherwise nobody here drives it. */
  heard: boolean;
  holder: LeaseState['holder'];
  /** The driver's name, by its grant. */
  driver: string | null;
  /** What this operator's grant allows; `null` if the robot asks for none. */
  role: Role | null;
  /** The device that this operator drives with; `null` while no grip is held. */
  device: string | null;
  /** Why a grip that is held does not drive; `null` if there is none. */
  gripLost: GripLoss | null;
  /** Whether the grip that drives was not read for a moment. */
  paused: boolean;
  /** Whether the emergency stop is latched. */
  stopped: boolean;
}

/** Who drives. */
export function holderWords({
  heard,
  holder,
  driver,
  role,
  device,
  gripLost,
  paused,
  stopped,
}: DrivingFacts): Words {
  if (!heard) return { text: 'The robot does not hear you', tone: 'bad' };
  if (holder === 'other') return { text: `${driver ?? 'Someone else'} is driving`, tone: 'warning' };
  if (stopped && (device !== null || gripLost !== null))
    return { text: 'STOP is on: let go, release it, then drive', tone: 'bad' };
  if (role === 'watch') return { text: 'Nobody is driving. Your grant lets you watch', tone: 'neutral' };
  if (gripLost !== null && device === null)
    return { text: 'Let go of the grip, then drive', tone: 'warning' };
  if (paused) return { text: 'Hold on: your grip was not read for a moment', tone: 'warning' };
  if (holder === 'nobody') return { text: 'Nobody is driving', tone: 'neutral' };
  return { text: device === null ? 'You have control' : `You are driving (${device})`, tone: 'good' };
}

/** What is known of a loss besides its kind. */
export interface LossFacts {
  /** How many operators the robot takes; `null` if it has not said so. */
  maxOperators: number | null;
  /** What the robot said about it; `null` if nothing. */
  lossDetail: string | null;
}

/** Why a session ended. */
export function wordsOfLoss(loss: SessionLoss, { maxOperators, lossDetail }: LossFacts): string {
  if (loss === 'robot-full') return fullWords(maxOperators, lossDetail);
  // Who did it is what matters.
  if (loss === 'ended-by-supervisor' && lossDetail !== null)
    return `${lossDetail}. Choose the robot to connect again.`;
  return lossWords[loss];
}

function fullWords(maxOperators: number | null, detail: string | null): string {
  // Why there is no place for this operator in particular.
  if (detail !== null) return `The robot has no place for you: ${detail}. Trying again…`;
  if (maxOperators === null) return 'The robot is full: it accepts no more operators. Trying again…';
  const operators = maxOperators === 1 ? 'one operator' : `${maxOperators} operators`;
  return `The robot is full: it accepts ${operators} at most. Trying again…`;
}

/** Shown when another robot has been chosen. */
export const leavingWords = 'Stopping this robot first…';

export interface LinkFacts {
  phase: SessionPhase;
  signaling: SignalingState;
  robotListed: boolean;
  /** Why the last session ended. */
  lastLoss: SessionLoss | null;
  /** How many operators the robot takes; `null` if it has not said so. */
  maxOperators: number | null;
  /** What the robot said about the last session's end; `null` if nothing. */
  lossDetail: string | null;
  /** Until the operator's grant ends, ms; `null` if the robot asks for none. */
  grantLeftMs: number | null;
  /** Time since the last message or point from the robot, ms, and what that means. */
  silentMs: number;
  silence: Silence;
  /** Time since the last point, ms. */
  pointsSilentMs: number;
  /** The robot plays files. */
  plays: boolean;
  /** The robot learns the path's state from receiver reports only. */
  rateByReports: boolean;
}

/**
 * Without points for so long, the link's line says so, ms. Chosen: points may be missing while a sensor starts or a link
 * is narrow. status.test.ts holds it.
 */
const NO_POINTS_MS = 3000;

/** The state of the link in one line. */
export function linkWords(facts: LinkFacts): Words {
  switch (facts.phase) {
    case 'none':
      return signalingWords[facts.signaling];
    case 'waiting':
      if (facts.signaling !== 'ready') return signalingWords[facts.signaling];
      if (!facts.robotListed) {
        return { text: 'The robot is offline. Waiting for it to come back…', tone: 'warning' };
      }
      if (facts.lastLoss !== null && finalLosses.has(facts.lastLoss))
        return { text: wordsOfLoss(facts.lastLoss, { maxOperators: null, lossDetail: null }), tone: 'bad' };
      return facts.lastLoss === 'robot-full'
        ? { text: fullWords(facts.maxOperators, facts.lossDetail), tone: 'warning' }
        : { text: 'Connecting…', tone: 'neutral' };
    case 'opening':
      return { text: 'Connecting to the robot…', tone: 'neutral' };
    case 'live': {
      const grantEnds = grantEndsWords(facts.grantLeftMs);
      // The banner says what to do.
      if (facts.silence === 'lost') {
        const seconds = Math.max(1, Math.round(facts.silentMs / 1000));
        return { text: `Connection lost for ${seconds} s`, tone: 'bad' };
      }
      if (facts.silence === 'unheard') return { text: 'Nothing comes from the robot', tone: 'warning' };
      if (grantEnds !== null) return grantEnds;
      if (facts.pointsSilentMs >= NO_POINTS_MS) {
        return { text: 'Connected, but no points are arriving.', tone: 'warning' };
      }
      if (facts.signaling !== 'ready') return { text: 'Live (signaling offline)', tone: 'good' };
      if (facts.rateByReports) {
        return {
          text: 'Live, at a cautious rate: the connection has no transport-wide feedback.',
          tone: 'warning',
        };
      }
      return { text: facts.plays ? 'Playback' : 'Live', tone: 'good' };
    }
  }
}

/** Why a camera's video is not shown, if it is this browser that cannot. */
export const videoWords = {
  tooOld: 'This browser cannot show videos in step. Update it.',
  noCodec: 'This browser cannot decode this video.',
} as const;

export const failureWords = {
  noWebGl2: {
    title: 'This browser cannot draw the point cloud',
    text: 'WebGL 2 is missing, or hardware acceleration is off. Turn hardware acceleration on, or use another browser.',
  },
  noWebRtc: {
    title: 'This browser has no WebRTC',
    text: 'Use a current Chrome, Edge, Safari or the headset’s own browser. Open the page over https or on localhost.',
  },
  noTransform: {
    title: 'This browser cannot receive point packets',
    text: 'It lacks encoded transforms (RTCRtpScriptTransform). Update the browser; a Quest needs version 42 or newer.',
  },
  workerFailed: {
    title: 'The point decoder could not start',
    text: 'Reload the page. If that does not help, the server is not delivering the page’s WebAssembly file.',
  },
  contextLost: {
    title: 'The graphics system was reset',
    text: 'The picture returns automatically in a moment.',
  },
} as const;

/** The page's server does not let it connect there. */
export function forbiddenAddressWords(address: string): string {
  return `This page may not connect to ${address}. Whoever runs its server can allow it (--connect-origins).`;
}

/** Why VR is unavailable; `null` if it is available. */
export function vrUnavailable(facts: {
  secure: boolean;
  hasWebXr: boolean;
  supported: boolean;
}): string | null {
  if (facts.supported) return null;
  if (!facts.secure) return 'VR needs https: open the page at its https address.';
  if (!facts.hasWebXr) return 'This browser has no WebXR. To use VR, open the page in a headset’s browser.';
  return 'No headset found.';
}

/** @returns `null` unless the grant ends soon */
export function grantEndsWords(leftMs: number | null): Words | null {
  if (leftMs === null || leftMs > GRANT_ENDS_SOON_S * 1000) return null;
  const seconds = Math.max(0, Math.ceil(leftMs / 1000));
  return {
    text: `Your grant ends in ${seconds} s. Then the robot stops and the session ends.`,
    tone: 'warning',
  };
}
