/** What the page says, in plain words: one place for every state, refusal and failure a person may meet. */

import type { SessionLoss, SessionPhase, SignalingState } from '@farpoint/operator';
import type { CommandRejection, DriveState, LeaseState } from '@farpoint/protocol';

export type Tone = 'good' | 'neutral' | 'warning' | 'bad';

export interface Words {
  text: string;
  tone: Tone;
}

export const driveWords: Record<DriveState, Words> = {
  driving: { text: 'Driving', tone: 'good' },
  idle: { text: 'Standing', tone: 'neutral' },
  watchdog: { text: 'Stopped: no fresh command', tone: 'warning' },
  estop: { text: 'Emergency stop', tone: 'bad' },
  blocked: { text: 'Blocked by an obstacle', tone: 'warning' },
};

export const rejectionWords: Record<CommandRejection, string> = {
  malformed: 'The robot could not read a command.',
  'out-of-range': 'The robot refused a speed beyond its limits.',
  stale: 'Commands reach the robot too late. It stands still until the link is better.',
  repeated: 'The robot refused a command that came out of order.',
  'not-lease-holder': 'Someone else drives this robot. Ask to take over.',
  'dead-man-released': 'The robot moves only while the grip is held.',
  'let-go-first': 'The link was away while the grip was held. Let go of it, then drive.',
  'estop-latched': 'The emergency stop is on. Release it, let go of the grip, then drive.',
  'rate-limited': 'The robot gets more commands than it reads.',
};

export const signalingWords: Record<SignalingState, Words> = {
  connecting: { text: 'Connecting to the signaling service…', tone: 'neutral' },
  ready: { text: 'Signaling connected', tone: 'good' },
  waiting: { text: 'The signaling service cannot be reached. Trying again…', tone: 'warning' },
  refused: { text: 'The signaling service refused the token. Correct it in the settings.', tone: 'bad' },
  stopped: { text: 'Signaling is off', tone: 'neutral' },
};

const lossWords: Record<Exclude<SessionLoss, 'robot-full'>, string> = {
  'not-connected': 'No connection to the robot came about. Trying again…',
  'connection-failed': 'The connection to the robot is lost. The robot has stopped by itself. Trying again…',
  'closed-by-robot': 'The robot ended the session. Trying again…',
  'robot-restarted': 'The robot has restarted. Connecting anew…',
  'robot-stopped': 'The robot was shut down. Waiting for it to come back…',
  'robot-left': 'The robot went away while connecting. Trying again…',
  'bad-answer':
    'The robot cannot use what this browser offers. Update the browser, or use another one. Trying again…',
  'unproven-peer':
    'The robot refused the connection: its encryption ended at somebody else than this page. Trying again…',
  'not-reading': 'This page did not keep up with the robot’s messages. Connecting anew…',
  unheard: 'The robot heard nothing of this page for long. Connecting anew…',
  silent: 'Nothing is heard from the robot. Trying again…',
  'signaling-lost': 'The signaling service went away while connecting. Trying again…',
  refused: 'The service did not open a session. Trying again…',
};

/** Who drives. @param device that this operator drives with; `null` while no grip is held */
export function holderWords(holder: LeaseState['holder'], device: string | null): Words {
  if (holder === 'other') return { text: 'Someone else drives', tone: 'warning' };
  if (holder === 'nobody') return { text: 'Nobody drives', tone: 'neutral' };
  return { text: device === null ? 'You may drive' : `You drive (${device})`, tone: 'good' };
}

/** Why a session was given up. @param maxOperators how many the robot takes, where it has said so */
export function wordsOfLoss(loss: SessionLoss, maxOperators: number | null): string {
  return loss === 'robot-full' ? fullWords(maxOperators) : lossWords[loss];
}

function fullWords(maxOperators: number | null): string {
  if (maxOperators === null) return 'The robot is full: it takes no more operators. Trying again…';
  const operators = maxOperators === 1 ? 'one operator' : `${maxOperators} operators`;
  return `The robot is full: it takes ${operators} at most. Trying again…`;
}

/** Another robot was chosen. */
export const leavingWords = 'This robot stops first…';

export interface LinkFacts {
  phase: SessionPhase;
  signaling: SignalingState;
  robotListed: boolean;
  /** Why the last session was given up. */
  lastLoss: SessionLoss | null;
  /** How many operators the robot takes, where it has said so. */
  maxOperators: number | null;
  /** Since the last message or point of the robot, ms. */
  silentMs: number;
  /** Since the last point, ms. */
  pointsSilentMs: number;
  /** The robot learns of the path from receiver reports alone. */
  rateByReports: boolean;
}

const SILENT_MS = 1000;
const NO_POINTS_MS = 3000;

/** The state of the link in one line. */
export function linkWords(facts: LinkFacts): Words {
  switch (facts.phase) {
    case 'none':
      return signalingWords[facts.signaling];
    case 'waiting':
      if (facts.signaling !== 'ready') return signalingWords[facts.signaling];
      if (!facts.robotListed) {
        return { text: 'The robot is away. Waiting for it to come back…', tone: 'warning' };
      }
      return facts.lastLoss === 'robot-full'
        ? { text: fullWords(facts.maxOperators), tone: 'warning' }
        : { text: 'Connecting…', tone: 'neutral' };
    case 'opening':
      return { text: 'Connecting to the robot…', tone: 'neutral' };
    case 'live':
      if (facts.silentMs >= SILENT_MS) {
        return {
          text: `Connection lost for ${Math.round(facts.silentMs / 1000)} s. The robot stops by itself. Trying to reach it…`,
          tone: 'bad',
        };
      }
      if (facts.pointsSilentMs >= NO_POINTS_MS) {
        return { text: 'Connected, but no points arrive.', tone: 'warning' };
      }
      if (facts.signaling !== 'ready') return { text: 'Live (signaling is away)', tone: 'good' };
      if (facts.rateByReports) {
        return {
          text: 'Live, at a cautious rate: the connection gives no transport-wide feedback.',
          tone: 'warning',
        };
      }
      return { text: 'Live', tone: 'good' };
  }
}

export const failureWords = {
  noWebGl2: {
    title: 'This browser cannot draw the point cloud',
    text: 'It has no WebGL 2, or its graphics acceleration is off. Switch hardware acceleration on, or use another browser.',
  },
  noWebRtc: {
    title: 'This browser has no WebRTC',
    text: 'Use a current Chrome, Edge, Safari or the headset’s own browser, and open the page over https or on localhost.',
  },
  noTransform: {
    title: 'This browser cannot hand over the point packets',
    text: 'It lacks encoded transforms (RTCRtpScriptTransform). Update the browser; on a Quest, version 42 or newer.',
  },
  workerFailed: {
    title: 'The point decoder could not be started',
    text: 'Reload the page. If it stays so, the server does not deliver the page’s WebAssembly file.',
  },
  contextLost: {
    title: 'The graphics system was reset',
    text: 'The picture comes back by itself in a moment.',
  },
} as const;

/** Why there is no VR button, or `null` where there can be one. */
export function vrUnavailable(facts: {
  secure: boolean;
  hasWebXr: boolean;
  supported: boolean;
}): string | null {
  if (facts.supported) return null;
  if (!facts.secure) return 'VR needs https: open the page by its https address.';
  if (!facts.hasWebXr) return 'This browser has no WebXR. VR works in a headset’s browser.';
  return 'No headset found.';
}
