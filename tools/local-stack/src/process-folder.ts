import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const folders: string[] = [];

/** A new folder, which goes with this process, however the process ends but by a signal. @param parent where it is made */
export function processFolder(parent = tmpdir()): string {
  const folder = mkdtempSync(join(parent, 'farpoint-'));
  if (folders.push(folder) === 1)
    process.once('exit', () => {
      for (const each of folders) rmSync(each, { recursive: true, force: true });
    });
  return folder;
}
