import { renameSync, writeFileSync } from 'node:fs';

/**
 * Replaces a file at once: a reader finds either the old text or the new one, also after a loss of power.
 *
 * @param mode permissions of the new file
 * @throws {Error} of the system
 */
export function replaceFile(path: string, text: string, mode: number): void {
  const draft = `${path}.new`;
  writeFileSync(draft, text, { mode, flush: true });
  renameSync(draft, path);
}
