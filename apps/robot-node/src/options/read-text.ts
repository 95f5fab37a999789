import { readFileSync } from 'node:fs';
import { fileFault } from '@farpoint/service';

/** A file that an option names; empty after a refusal. */
export function readText(path: string, refuse: (detail: string) => void): string {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    refuse(`cannot be read: ${fileFault(error) ?? String(error)}`);
    return '';
  }
}
