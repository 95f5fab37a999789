import type { RobotEndReason } from '@farpoint/protocol';

/** Why a session was given up. */
export type SessionLoss =
  /** No peer connection came about in time. */
  | 'not-connected'
  /** ICE, DTLS or a channel ended. */
  | 'connection-failed'
  /** It takes no more operators. */
  | 'robot-full'
  /** It does not know the session any more. */
  | 'robot-restarted'
  /** It was shut down. */
  | 'robot-stopped'
  /** It went away before the peers had met. */
  | 'robot-left'
  /** It cannot use what this browser answered. */
  | 'bad-answer'
  /** Somebody between the peers, or another certificate than this browser named. */
  | 'unproven-peer'
  /** Its messages piled up. */
  | 'not-reading'
  /** It heard nothing of this page for long. */
  | 'unheard'
  | 'closed-by-robot'
  /** Nothing heard for long. */
  | 'silent'
  /** Before the peers had met. */
  | 'signaling-lost'
  /** The service would not open it. */
  | 'refused';

/** What a robot's reason is to the page. */
export const lossOf: Readonly<Record<RobotEndReason, SessionLoss>> = {
  'robot-full': 'robot-full',
  'bad-answer': 'bad-answer',
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
