import type { Broadcast } from '@farpoint/protocol';
import type { RobotEvents } from '../client/robot-events.ts';
import type { WatchState } from './watch-state.ts';

/** The events of {@link RobotWatcher.on}: of a {@link RobotClient}, those about what is seen. */
export interface WatchEvents extends RobotEvents {
  /** Whether anything can be seen, and why not. */
  watching: WatchState;
  /** What the robot broadcasts; again whenever it changes. */
  broadcast: Broadcast;
}
