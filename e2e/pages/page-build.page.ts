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

/** The scripts of the deployed page that contain this text. */
function scriptsWith(text: string): string[] {
  const folder = join(repositoryRoot, 'apps/webxr/dist');
  return globSync('assets/*.js', { cwd: folder }).filter((file) =>
    readFileSync(join(folder, file), 'utf8').includes(text),
  );
}

/** The scripts that a page loads before anything else. */
function namedIn(page: string): string[] {
  const html = readFileSync(join(repositoryRoot, 'apps/webxr/dist', page), 'utf8');
  return [...html.matchAll(/(?:src|href)="\.\/(assets\/[^"]+\.js)"/g)].map(([, file]) => file as string);
}

/** A text that is shown from the beginning, and one of a dialog, in each language. */
const LANGUAGES = [
  { language: 'English', first: 'The robot does not respond', later: 'Keys for' },
  { language: 'German', first: 'Der Roboter antwortet nicht', later: 'Tasten für' },
];

/** What the page loads before anybody enters VR, compressed with gzip, bytes. Aim of the project: 2 s at 10 Mbit/s with room to spare. */
const MOST_BEFORE_VR = 350_000;

test('each file of the deployed page is there compressed', () => {
  const folder = join(repositoryRoot, 'apps/webxr/dist');
  const files = globSync('**/*.{html,js,css,wasm}', { cwd: folder });
  expect(files.length).toBeGreaterThan(20);
  expect(files.filter((file) => ['.br', '.gz'].some((end) => !existsSync(join(folder, file + end))))).toEqual(
    [],
  );
});

for (const { language, first, later } of LANGUAGES) {
  test(`before VR, the page in ${language} loads one catalogue, and its scripts are within their limit`, () => {
    const folder = join(repositoryRoot, 'apps/webxr/dist');
    const [catalogue, ...others] = scriptsWith(first);
    expect(others).toEqual([]);
    // Each worker that any robot, browser or choice may start.
    const workers = globSync('assets/*-worker-*.js', { cwd: folder });
    expect(workers.length).toBe(5);
    const atOnce = namedIn('index.html');
    expect(atOnce.length).toBeGreaterThan(0);
    const loaded = [...atOnce, catalogue as string, ...workers];
    const bytes = loaded.map((file) => statSync(join(folder, `${file}.gz`)).size);
    expect(bytes.reduce((sum, each) => sum + each, 0)).toBeLessThan(MOST_BEFORE_VR);
    // What dialogs say is loaded with the first of them.
    const ofDialogs = scriptsWith(later);
    expect(ofDialogs.length).toBe(1);
    for (const page of ['index.html', 'wall.html', 'watch.html'])
      for (const file of [catalogue, ...ofDialogs]) expect(namedIn(page)).not.toContain(file);
  });
}
