import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './run.ts';

/** Paths of the files that git tracks or would track, from the repository's root. */
export const workspaceFiles: readonly string[] = execFileSync(
  'git',
  ['ls-files', '--cached', '--others', '--exclude-standard'],
  { cwd: root, encoding: 'utf8' },
)
  .split('\n')
  .filter((file) => file !== '');

export function readWorkspaceFile(file: string): string {
  return readFileSync(join(root, file), 'utf8');
}
