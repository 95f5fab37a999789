import { mkdirSync, statfsSync, statSync } from 'node:fs';
import { dirname, resolve } from 'node:path';

/**
 * Makes a folder and those above it that are missing. The system's own way to do so never returns where no folder can
 * be made, as in /proc.
 *
 * @param mode permissions of the new folders
 * @throws {Error} of the system
 */
export function makeFolder(path: string, mode: number): void {
  try {
    mkdirSync(path, { mode });
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    if (code === 'EEXIST' && kindOf(path) === 'folder') return;
    const above = dirname(resolve(path));
    if (code !== 'ENOENT' || kindOf(above) !== 'nothing') throw error;
    makeFolder(above, mode);
    // Somebody else may have made it meanwhile.
    if (kindOf(path) !== 'folder') mkdirSync(path, { mode });
  }
}

/** File systems that the kernel makes up: /proc, /sys, and control groups. */
const MADE_UP: ReadonlySet<number> = new Set([0x9fa0, 0x6265_6572, 0x27_e0eb, 0x6367_7270]);

/** Why there can be no folder here, without making one; `null` if there is one, or nothing speaks against it. */
export function folderFault(path: string): string | null {
  let at = resolve(path);
  while (kindOf(at) === 'nothing' && dirname(at) !== at) at = dirname(at);
  if (kindOf(at) === 'other')
    return at === resolve(path) ? 'is a file, not a folder' : `is below a file: ${at}`;
  try {
    if (MADE_UP.has(statfsSync(at).type)) return `is in ${at}, which keeps no files`;
  } catch {
    // Then the system says so when the folder is made.
  }
  return null;
}

function kindOf(path: string): 'folder' | 'other' | 'nothing' {
  try {
    return statSync(path).isDirectory() ? 'folder' : 'other';
  } catch {
    return 'nothing';
  }
}
