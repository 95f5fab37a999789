/** How a robot drives back by itself. Lengths in metres, speeds in m/s and rad/s, times in ms. */
export interface ReturnOptions {
  /** Begins after no operator has been heard for so long. */
  afterMs: number;
  /** Says so for so long before it moves. */
  announceMs: number;
  /** Goes back no farther than this along its track. */
  maxM: number;
  /** Highest speed, and highest rate of turning. */
  maxLinear: number;
  maxAngular: number;
  /** Farther from its track than this, it gives up. */
  toleranceM: number;
  /** Gives up after it has got nowhere for so long. */
  blockedMs: number;
  /** Gives up after it has been on its way for so long. */
  longestMs: number;
  /** Where no sensor sees: it waits, or goes on. */
  unseen: 'stop' | 'slow';
}

export const defaultReturnOptions: Readonly<ReturnOptions> = Object.freeze({
  afterMs: 10_000,
  announceMs: 3000,
  maxM: 20,
  maxLinear: 0.2,
  maxAngular: 0.5,
  toleranceM: 0.3,
  blockedMs: 20_000,
  longestMs: 300_000,
  unseen: 'stop',
});

/**
 * Odometry that is older is silent: the robot must not move, ms. As long as the guard carries it on
 * (obstacle-guard-options.ts): at 0.2 m/s, 6 cm.
 */
export const ODOMETRY_SILENT_MS = 300;
