/** What an obstacle guard must know of its robot. Lengths in metres, speeds in m/s, times in ms. */
export interface ObstacleGuardOptions {
  /** Kept free of obstacles around the footprint, at walking speed. */
  marginM: number;
  /** Highest speed towards where no sensor sees, and while a sensor is silent. */
  unseenMps: number;
  /** A sensor whose last cloud is older is silent. */
  silentAfterMs: number;
  /** From a cloud's capture to the wheels' answer, besides the cloud's age. */
  reactionMs: number;
  /** With which the robot slows down before an obstacle: m/s² and rad/s². */
  braking: { linear: number; angular: number };
  /** With which it brakes as hard as it can. */
  emergency: { linear: number; angular: number };
  /** The robot is slowed down until it would need this long to reach an obstacle. */
  timeToCollisionMs: number;
  /** How long what is no longer seen counts as free, and as occupied. */
  freeMemoryMs: number;
  occupiedMemoryMs: number;
  /** Length of the sensors' cells. */
  cellM: number;
  /** How many of the sensors, the last ones, see one plane only, as a laser scanner does. */
  planes: number;
  /** Whether floor over which such a sensor sees nothing counts as seen. */
  planesShowFloor: boolean;
  /** Whether something is to say where the robot is: the robot is slow while nothing does. */
  odometry: boolean;
}

export const defaultObstacleGuardOptions: Readonly<ObstacleGuardOptions> = {
  marginM: 0.15,
  unseenMps: 0.3,
  silentAfterMs: 400,
  reactionMs: 100,
  braking: { linear: 1, angular: 2 },
  emergency: { linear: 2, angular: 3 },
  timeToCollisionMs: 600,
  freeMemoryMs: 3000,
  occupiedMemoryMs: 20_000,
  cellM: 0.05,
  planes: 0,
  planesShowFloor: false,
  odometry: false,
};

/**
 * How much of the margin is kept even when the robot creeps. The robot gets through a narrow door with 10
 * of 15 cm: docs/obstacle-guard.md says both; `pnpm bench guard-runs` counts contacts and false stops with
 * these numbers.
 */
export const CREEPING_SHARE = 2 / 3;
/**
 * The highest speed within the rest of the margin, m/s. Chosen: it stops within 4 cm from there, with 0.1 s
 * of reaction and 1 m/s².
 */
export const CREEPING_MPS = 0.2;
/**
 * Slower than this, the robot stops; and it goes again when it may be faster than that, m/s. The gap between
 * them keeps it from jerking at the edge of a zone.
 */
export const STOP_BELOW_MPS = 0.04;
export const GO_ABOVE_MPS = 0.1;
/**
 * Emergency braking ends when the robot could stop within this share of the way. Chosen: without a gap it
 * would brake hard and let go by turns.
 */
export const RELEASE_SHARE = 0.7;
/**
 * Odometry is carried on by its velocity for at most this long; older, it is silent, ms.
 * docs/obstacle-guard.md says it; obstacle-guard.test.ts holds it.
 */
export const MOST_EXTRAPOLATION_MS = 300;
