import { globSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { repositoryRoot } from '@farpoint/local-stack';
import { expect, test } from '@playwright/test';

/** All scripts of one build of the page, joined. */
function scripts(build: string): string {
  const folder = join(repositoryRoot, 'apps/webxr', build);
  const files = globSync('assets/*.js', { cwd: folder });
  expect(files, `${build}: run \`pnpm build\``).not.toEqual([]);
  return files.map((file) => readFileSync(join(folder, file), 'utf8')).join('\n');
}

/** The modules that have code in a build's scripts. */
function modules(build: string): string[] {
  const folder = join(repositoryRoot, 'apps/webxr', build);
  const maps = globSync('assets/*.js.map', { cwd: folder });
  expect(maps, `${build}: run \`pnpm build\``).not.toEqual([]);
  return maps.flatMap((file) => {
    const { sources } = JSON.parse(readFileSync(join(folder, file), 'utf8')) as { sources: string[] };
    return sources;
  });
}

test('the deployed page does not contain the test interface', () => {
  expect(scripts('dist-testing')).toContain('latencyResults');
  expect(scripts('dist')).not.toContain('latencyResults');
});

test('the page has the small build of the schema library, with a single language', () => {
  const ofZod = modules('dist').flatMap((source) => source.split('/zod/v4/')[1] ?? []);
  expect(ofZod).toContain('mini/schemas.js');
  expect(ofZod.filter((module) => module.startsWith('classic/'))).toEqual([]);
  expect(ofZod.filter((module) => module.startsWith('locales/'))).toEqual(['locales/en.js']);
});

test('the page is small: its scripts, with all that the headset needs, are at most 350 kB compressed', () => {
  const folder = join(repositoryRoot, 'apps/webxr/dist');
  const page = readFileSync(join(folder, 'index.html'), 'utf8');
  const named = [...page.matchAll(/(?:src|href)="\.\/(assets\/[^"]+\.js)"/g)].map(([, file]) => file ?? '');
  expect(named).not.toEqual([]);
  const bytes = named.map((file) => gzipSync(readFileSync(join(folder, file)), { level: 9 }).length);
  expect(bytes.reduce((sum, each) => sum + each, 0)).toBeLessThan(350_000);
});
