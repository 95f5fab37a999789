/** A hand moved by a test or a benchmark: `window.farpoint.drive`. */
import type { DriveInput } from './drive-input.ts';
import type { DriveWish } from './velocity-mapping.ts';

export class ScriptInput implements DriveInput {
  readonly name = 'script';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
}
