import { join } from 'node:path';
import { repositoryRoot } from './repository-root.ts';

/** A program of this repository, by its folder in `apps/`. */
export type ProgramName = 'bridge' | 'issuer' | 'link-emulator' | 'robot-node' | 'signaling';

/**
 * What Node runs for a program: its sources, or the file that `scripts/lib/bundle-programs.ts` made of them, in the folder
 * that `FARPOINT_PROGRAMS` names. That starts in a third of the time, and is as old as the folder is.
 */
export function programPath(name: ProgramName): string {
  const folder = process.env.FARPOINT_PROGRAMS ?? '';
  return folder === '' ? join(repositoryRoot, 'apps', name, 'src', 'main.ts') : join(folder, `${name}.mjs`);
}
