/** What is in the built page, and what must not be. */
import { existsSync, globSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
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

/** Words of the test interface, and of the scripted robot and its states. */
const OF_TESTS = ['latencyResults', 'farpointStage', 'Robot on a stage', 'stop-unconfirmed'];

test('the deployed page contains neither the test interface nor a scripted robot', () => {
  for (const word of OF_TESTS) {
    expect(scripts('dist-testing')).toContain(word);
    expect(scripts('dist')).not.toContain(word);
  }
  expect(modules('dist-testing').filter((source) => /\/testing\//.test(source)).length).toBeGreaterThan(5);
  expect(modules('dist').filter((source) => /\/testing\//.test(source))).toEqual([]);
});

test('the page has the small build of the schema library, with a single language', () => {
  const ofZod = modules('dist').flatMap((source) => source.split('/zod/v4/')[1] ?? []);
  expect(ofZod).toContain('mini/schemas.js');
  expect(ofZod.filter((module) => module.startsWith('classic/'))).toEqual([]);
  expect(ofZod.filter((module) => module.startsWith('locales/'))).toEqual(['locales/en.js']);
});

/** What each page loads before anybody enters VR, compressed with gzip, bytes. Aim of the project: 2 s at 10 Mbit/s with room to spare. */
const MOST_BEFORE_VR = 350_000;

test('each file of the deployed page is there compressed, and its scripts before VR are within their limit', () => {
  const folder = join(repositoryRoot, 'apps/webxr/dist');
  const files = globSync('**/*.{html,js,css,wasm}', { cwd: folder });
  expect(files.filter((file) => ['.br', '.gz'].some((end) => !existsSync(join(folder, file + end))))).toEqual(
    [],
  );
  const atOnce = [
    ...readFileSync(join(folder, 'index.html'), 'utf8').matchAll(/(?:src|href)="\.\/(assets\/[^"]+\.js)"/g),
  ].map(([, file]) => file as string);
  // What decodes every robot's points. Other workers are started for what a robot has, or an operator chooses.
  const workers = files.filter((file) => /(cloud|stamp)-worker-.*js$/.test(file));
  expect(atOnce.length).toBeGreaterThan(0);
  expect(workers.length).toBe(2);
  const bytes = [...atOnce, ...workers].map((file) => statSync(join(folder, `${file}.gz`)).size);
  expect(bytes.reduce((sum, each) => sum + each, 0)).toBeLessThan(MOST_BEFORE_VR);
});

test('languages other than English are loaded only when they are spoken', () => {
  const folder = join(repositoryRoot, 'apps/webxr/dist');
  const german = globSync('assets/*.js', { cwd: folder }).filter((file) =>
    readFileSync(join(folder, file), 'utf8').includes('Der Roboter'),
  );
  expect(german.length).toBe(1);
  const pages = ['index.html', 'watch.html'].map((page) => readFileSync(join(folder, page), 'utf8'));
  for (const page of pages) expect(page).not.toContain(german[0]);
});
