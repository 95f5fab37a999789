import { globSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { expect, test } from '@playwright/test';

/** The scripts of one build of the page, all in one. */
function scripts(build: string): string {
  const folder = join(repositoryRoot, 'apps/webxr', build);
  const files = globSync('assets/*.js', { cwd: folder });
  expect(files, `${build}: run \`pnpm build\``).not.toEqual([]);
  return files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n');
}

test('what tests do with the page is not in the page that is deployed', () => {
  expect(scripts('dist-testing')).toContain('latencyResults');
  expect(scripts('dist')).not.toContain('latencyResults');
});
