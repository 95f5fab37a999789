import type { RobotEndReason } from '@farpoint/protocol';

/** Why a session was given up. */
export type SessionLoss =
  | 'not-connected' // no peer connection came about in time
  | 'connection-failed' // ICE, DTLS or a channel ended
  | 'robot-full' // it takes no more operators
  | 'robot-restarted' // it does not know the session any more
  | 'robot-stopped' // it was shut down
  | 'robot-left' // it went away before the peers had met
  | 'bad-answer' // it cannot use what this browser answered
  | 'unproven-peer' // somebody between the peers, or another certificate than this browser named
  | 'not-reading' // its messages piled up
  | 'unheard' // it heard nothing of this page for long
  | 'closed-by-robot'
  | 'silent' // nothing heard for long
  | 'signaling-lost' // before the peers had met
  | 'refused'; // the service would not open it

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
