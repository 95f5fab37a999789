import { JanusFailure } from '@farpoint/janus';
import { type Broadcast, ProtocolError } from '@farpoint/protocol';
import type { RobotEvents } from '../client/robot-events.ts';

/** Why nothing can be watched at present. */
export type WatchObstacle =
  /** Janus does not answer. */
  | 'relay-unreachable'
  /** Janus does not have the robot's mountpoint. */
  | 'no-broadcast'
  /** The mountpoint is not a robot's, or of another version. */
  | 'not-a-broadcast'
  /** Janus refuses: the PIN is wrong. */
  | 'refused'
  /** It was there a moment ago. */
  | 'lost';

/**
 * What a {@link RobotWatcher} does: `connecting`, it asks Janus; `waiting`, it will try again; `opening`, Janus has
 * agreed and nothing has arrived yet; `live`, pictures or points arrive; `silent`, connected, but nothing has arrived
 * for more than a second.
 */
export type WatchPhase = 'connecting' | 'waiting' | 'opening' | 'live' | 'silent';

/** Whether anything can be seen, and why not. */
export interface WatchState {
  /** What the watcher does at present. */
  readonly phase: WatchPhase;
  /** While it waits: why nothing can be watched; otherwise `null`. */
  readonly obstacle: WatchObstacle | null;
  /** While it waits, for people: what Janus or the browser said. */
  readonly detail: string;
}

/** The events of {@link RobotWatcher.on}: of a {@link RobotClient}, those about what is seen. */
export interface WatchEvents extends RobotEvents {
  /** Whether anything can be seen, and why not. */
  watching: WatchState;
  /** What the robot broadcasts; again whenever it changes. */
  broadcast: Broadcast;
}

export function obstacleOf(error: unknown): WatchObstacle {
  if (error instanceof ProtocolError) return 'not-a-broadcast';
  if (!(error instanceof JanusFailure)) return 'lost';
  if (error.reason === 'no-mountpoint') return 'no-broadcast';
  return error.reason === 'unauthorised' ? 'refused' : 'relay-unreachable';
}
