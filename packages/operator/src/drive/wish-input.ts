/** Input from a program. A wish expires soon, so that a program that hangs stops the robot. Time is an argument. */
import type { DriveInput } from './drive-input.ts';
import type { DriveWish } from './velocity-mapping.ts';

/**
 * A wish that is not renewed within this time expires, ms. Chosen: programs that renew it ten times a second
 * may miss one.
 */
export const WISH_HOLDS_MS = 200;

export class WishInput implements DriveInput {
  readonly name = 'script';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  /** A wish expires by itself. */
  readonly readMs = null;
  held = false;
  #renewedMs = 0;

  renew({ forward, left, sideways }: DriveWish, nowMs: number): void {
    this.wish.forward = forward;
    this.wish.left = left;
    this.wish.sideways = sideways;
    this.held = true;
    this.#renewedMs = nowMs;
  }

  release(): void {
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.wish.sideways = undefined;
  }

  /** Call several times a second. */
  lapse(nowMs: number): void {
    if (this.held && nowMs - this.#renewedMs >= WISH_HOLDS_MS) this.release();
  }
}
