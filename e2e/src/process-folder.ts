import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const folders: string[] = [];

/** A new folder, which goes with this process. */
export function processFolder(): string {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-test-'));
  if (folders.push(folder) === 1)
    process.once('exit', () => {
      for (const each of folders) rmSync(each, { recursive: true, force: true });
    });
  return folder;
}
