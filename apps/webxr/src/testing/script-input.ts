/** Drive input from a test or a benchmark: `window.farpoint.drive` and `window.farpoint.hold`. */
import type { DriveInput, DriveWish } from '@farpoint/operator';

export class ScriptInput implements DriveInput {
  readonly name = 'script';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  readonly readMs = null;
  held = false;

  hold(wish: Readonly<DriveWish>): void {
    this.wish.forward = wish.forward;
    this.wish.left = wish.left;
    this.wish.sideways = wish.sideways;
    this.held = true;
  }

  release(): void {
    this.held = false;
  }
}
