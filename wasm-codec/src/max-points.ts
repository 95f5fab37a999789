/** How many points of a frame to send: the paper's equations 2 and 3. */
import { CodecError } from './errors.ts';
import { POINTS_PER_PACKET } from './slot-layout.ts';

const BITS_PER_POINT = 64;

export interface PointBudget {
  /** BW: what the link carries, bit/s. */
  bitsPerSecond: number;
  /** FPS: frames per second, above 0. */
  framesPerSecond: number;
  /** n: points of the raw cloud. */
  points: number;
  /**
   * Lower limit, as a fraction of the raw cloud *per second*, whatever the link carries: the formula divides it by the
   * frame rate, although the paper's text says "at least 10 % of the raw cloud". Default 0.10.
   */
  floorFraction?: number;
}

/**
 * N_max = 150 · ⌊max(min(MFS / 64, n), floorFraction · n / FPS) / 150⌋ with MFS = BW / FPS: whole packets, so 0 if not
 * even one fits.
 *
 * @throws CodecError `bad-parameter`
 */
export function maxPoints({
  bitsPerSecond,
  framesPerSecond,
  points,
  floorFraction = 0.1,
}: PointBudget): number {
  check('bitsPerSecond', bitsPerSecond, bitsPerSecond >= 0);
  check('framesPerSecond', framesPerSecond, framesPerSecond > 0);
  check('points', points, points >= 0 && Number.isInteger(points));
  check('floorFraction', floorFraction, floorFraction >= 0 && floorFraction <= 1);
  const bitsPerFrame = bitsPerSecond / framesPerSecond;
  const affordable = Math.min(bitsPerFrame / BITS_PER_POINT, points);
  const least = (floorFraction * points) / framesPerSecond;
  return POINTS_PER_PACKET * Math.floor(Math.max(affordable, least) / POINTS_PER_PACKET);
}

function check(name: string, value: number, inRange: boolean): void {
  if (!inRange || !Number.isFinite(value)) throw new CodecError('bad-parameter', `${name} is ${value}`);
}
