import { globSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './run.ts';

/** Installed or built files; as in `.gitignore`. */
const NOT_SOURCES = new Set([
  '.git',
  '.farpoint',
  '.vitest',
  'node_modules',
  '__pycache__',
  'coverage',
  'build',
  'dist',
  'dist-testing',
  'output',
  'target',
]);

/** Paths of the project's own files, relative to the repository's root, with `/` between folders. */
export const workspaceFiles: readonly string[] = globSync('**', {
  cwd: root,
  exclude: ({ name }) => NOT_SOURCES.has(name),
  withFileTypes: true,
})
  .filter((entry) => entry.isFile())
  .map(({ parentPath, name }) =>
    join(parentPath, name).slice(root.length).replaceAll('\\', '/').replace(/^\//, ''),
  );

export function readWorkspaceFile(file: string): string {
  return readFileSync(join(root, file), 'utf8');
}
