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

/** What a {@link RobotWatcher} does at present. */
export type WatchState =
  /** It asks Janus. */
  | { readonly phase: 'connecting' }
  /** It will try again. */
  | { readonly phase: 'waiting'; readonly obstacle: WatchObstacle; readonly detail: string }
  /** Janus has agreed; nothing has arrived yet. */
  | { readonly phase: 'opening' }
  /** Pictures or points arrive. */
  | { readonly phase: 'live' }
  /** Connected, but nothing has arrived for more than a second. */
  | { readonly phase: 'silent' };
