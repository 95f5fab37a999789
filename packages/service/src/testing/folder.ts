/** Empty folders for tests, which go when they are no longer needed. */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, onTestFinished } from 'vitest';

/** @param parent where it is made, if its place matters */
function make(end: (remove: () => void) => void, parent: string): string {
  const folder = mkdtempSync(join(parent, 'farpoint-test-'));
  end(() => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/** For all tests of the file or the `describe` in which it is called. Those of its hooks that run later still have it. */
export function useFolder(parent = tmpdir()): string {
  return make(afterAll, parent);
}

/** For the test that runs. A `beforeEach` may call it, too. */
export function testFolder(parent = tmpdir()): string {
  return make(onTestFinished, parent);
}
