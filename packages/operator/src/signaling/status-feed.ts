import type { RobotStatus } from '@farpoint/protocol';

/** What robots say about themselves to whoever looks at their list, without a session. */
export interface StatusFeed {
  /** By robot id, while it is watched and the signaling service is there; else empty. */
  readonly statuses: ReadonlyMap<string, RobotStatus>;
  /** Whether to be told: on while the list is looked at. */
  watchStatuses(on: boolean): void;
}

/** Where nobody says it: at a bridge, and at an older signaling service. */
export const noStatusFeed: StatusFeed = {
  statuses: new Map(),
  watchStatuses: () => {},
};
