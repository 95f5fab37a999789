import type { RobotEndReason } from '@farpoint/protocol';

/** Why a session was given up. */
export type SessionLoss =
  /** No peer connection was established in time. */
  | 'not-connected'
  /** ICE, DTLS or a channel ended. */
  | 'connection-failed'
  /** The robot accepts no more operators. */
  | 'robot-full'
  /** The robot no longer knows the session. */
  | 'robot-restarted'
  /** The robot was shut down. */
  | 'robot-stopped'
  /** The robot left the service before the peers were connected. */
  | 'robot-left'
  /** The robot cannot use this browser's answer. */
  | 'bad-answer'
  /** The robot admits only operators with a grant that is valid for it. */
  | 'not-granted'
  /** The robot proves another key than the one by which it is known. */
  | 'robot-key-changed'
  /** The robot is known by a key, and does not prove it. */
  | 'robot-unproven'
  /** The operator's grant has ended. */
  | 'grant-expired'
  /** The operator's grant has been revoked. */
  | 'grant-revoked'
  /** A supervisor ended the session. The client does not connect again by itself. */
  | 'ended-by-supervisor'
  /** Somebody is between the peers, or the certificate is not the one that this browser named. */
  | 'unproven-peer'
  /** The page did not read the robot's messages fast enough. */
  | 'not-reading'
  /** The robot heard nothing from this page for too long. */
  | 'unheard'
  | 'closed-by-robot'
  /** The page heard nothing from the robot for too long. */
  | 'silent'
  /** Signaling was lost before the peers were connected. */
  | 'signaling-lost'
  /** The service refused to open the session. */
  | 'refused';

/** Maps the robot's reason to the page's. */
export const lossOf: Readonly<Record<RobotEndReason, SessionLoss>> = {
  'robot-full': 'robot-full',
  'bad-answer': 'bad-answer',
  'not-granted': 'not-granted',
  'grant-expired': 'grant-expired',
  'grant-revoked': 'grant-revoked',
  'ended-by-supervisor': 'ended-by-supervisor',
  'unproven-peer': 'unproven-peer',
  'not-connected': 'not-connected',
  'connection-lost': 'connection-failed',
  silent: 'unheard',
  'not-reading': 'not-reading',
  'shutting-down': 'robot-stopped',
  'robot-left': 'robot-left',
  'closed-by-robot': 'closed-by-robot',
  'unknown-session': 'robot-restarted',
};

/** Losses after which the same attempt would end the same way. The operator must do something first. */
export const finalLosses: ReadonlySet<SessionLoss> = new Set([
  'not-granted',
  'robot-key-changed',
  'robot-unproven',
]);
