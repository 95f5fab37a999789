import { shortestTurn } from '@farpoint/protocol';

/** Follows a position and a heading smoothly, for the rig that carries the operator's head. Allocates nothing. */
export class PoseFollower {
  x = 0;
  y = 0;
  z = 0;
  /** Radians, not wrapped. */
  yaw = 0;
  #started = false;
  readonly #timeConstantMs: number;

  /** @param timeConstantMs time after which 63 % of a step has been followed */
  constructor(timeConstantMs: number) {
    this.#timeConstantMs = timeConstantMs;
  }

  /** Makes the next pose apply at once. */
  reset(): void {
    this.#started = false;
  }

  get started(): boolean {
    return this.#started;
  }

  /** Stands there at once; only the height is followed. What is placed so is smooth by itself. */
  place(x: number, y: number, z: number, yaw: number, elapsedMs: number): void {
    const jump = !this.#started || Math.abs(z - this.z) > JUMP_M;
    this.z += (z - this.z) * (jump ? 1 : this.#share(elapsedMs));
    this.x = x;
    this.y = y;
    this.yaw = yaw;
    this.#started = true;
  }

  /** @param elapsedMs time since the last call */
  follow(x: number, y: number, z: number, yaw: number, elapsedMs: number): void {
    const dx = x - this.x;
    const dy = y - this.y;
    const dz = z - this.z;
    // A step longer than a stride is a jump to another place, not motion.
    const jump = !this.#started || dx * dx + dy * dy + dz * dz > JUMP_M * JUMP_M;
    const share = jump ? 1 : this.#share(elapsedMs);
    this.x += dx * share;
    this.y += dy * share;
    this.z += dz * share;
    this.yaw += shortestTurn(yaw - this.yaw) * share;
    this.#started = true;
  }

  #share(elapsedMs: number): number {
    return 1 - Math.exp(-Math.max(elapsedMs, 0) / this.#timeConstantMs);
  }
}

/**
 * Farther from one pose to the next, the robot is at another place, and nothing is blended, m. Chosen: no
 * robot here drives so far between two poses.
 */
export const JUMP_M = 2;
