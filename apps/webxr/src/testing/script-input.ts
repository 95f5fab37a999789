/** Drive input from a test or a benchmark: `window.farpoint.drive`. */
import type { DriveInput, DriveWish } from '@farpoint/operator';

export class ScriptInput implements DriveInput {
  readonly name = 'script';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  readonly readMs = null;
  held = false;
}
