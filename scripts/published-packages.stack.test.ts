/**
 * What `pnpm pack` puts in the tarballs: whatever is missing there, users miss. And a third party's page in a real browser
 * that is made of them. Nothing is fetched. In one file, because packing a package empties its `dist`.
 */
import { existsSync, globSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { CHROMIUM_REMEDY, findChromium, LocalStack, launchChromium } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder, useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, describe, expect, onTestFinished, test } from 'vitest';
import * as z from 'zod';
import { installOwnPage, serveFolder, typeFaults } from './lib/own-page.ts';
import { packPackage, publishedPackages } from './lib/published-packages.ts';
import { root, run } from './lib/run.ts';

const targets = z.union([z.string(), z.object({ types: z.string(), default: z.string() })]);
const manifestSchema = z.object({
  name: z.string(),
  version: z.string(),
  private: z.literal(false).optional(),
  license: z.literal('Apache-2.0'),
  type: z.literal('module'),
  description: z.string().min(20),
  engines: z.object({ node: z.string() }),
  exports: z.record(z.string(), targets),
  dependencies: z.record(z.string(), z.string()).default({}),
  peerDependencies: z.record(z.string(), z.string()).default({}),
});

const names = publishedPackages.map(({ name }) => name);
const folder = useFolder();
const installed = (name: string) => join(folder, 'node_modules', name);
/** By name: paths of files. */
const tarballs = new Map<string, string>();
const manifests = new Map<string, z.infer<typeof manifestSchema>>();
const manifestOf = (name: string) => manifests.get(name)!;

beforeAll(async () => {
  for (const each of publishedPackages) {
    const tarball = join(folder, `${each.folder.replace('/', '-')}.tgz`);
    await packPackage(each, tarball);
    tarballs.set(each.name, tarball);
    const place = installed(each.name);
    mkdirSync(place, { recursive: true });
    const { code, output } = await run('tar', ['xzf', tarball, '--strip-components=1', '-C', place]);
    if (code !== 0) throw new Error(output);
    const manifest: unknown = JSON.parse(readFileSync(join(place, 'package.json'), 'utf8'));
    manifests.set(each.name, manifestSchema.parse(manifest));
  }
  const workspace = join(root, 'packages/cloud-view/node_modules');
  mkdirSync(installed('@types'));
  for (const name of ['three', '@types/three']) symlinkSync(join(workspace, name), installed(name));
  writeFileSync(join(folder, 'package.json'), JSON.stringify({ type: 'module' }));
}, 120_000);

test('the operator and the cloud view are published, and nothing else', () => {
  expect([...names].sort()).toEqual(['@farpoint/cloud-view', '@farpoint/operator']);
});

describe.each(names)('%s', (name) => {
  test('asks for nothing that is not published', () => {
    const { dependencies, peerDependencies } = manifestOf(name);
    const needed = Object.entries({ ...dependencies, ...peerDependencies });
    const ours = needed.filter(([each]) => each.startsWith('@farpoint/'));
    expect(ours.map(([each]) => each).filter((each) => !names.includes(each))).toEqual([]);
    // A range that pnpm has left as it stands in the workspace installs nowhere else.
    expect(needed.filter(([, range]) => /^(workspace|catalog|link|file):/.test(range))).toEqual([]);
  });

  test('has every file that its exports and modules name', () => {
    const exported = Object.values(manifestOf(name).exports).flatMap((target) =>
      typeof target === 'string' ? [target] : [target.types, target.default],
    );
    expect(exported).not.toEqual([]);
    const place = installed(name);
    expect(exported.filter((file) => !existsSync(join(place, file)))).toEqual([]);
    const beside = globSync('dist/*.js', { cwd: place }).flatMap((file) =>
      [...readFileSync(join(place, file), 'utf8').matchAll(/new URL\("([^"]+)", import\.meta\.url\)/g)].map(
        ([, url]) => join('dist', url!),
      ),
    );
    expect(beside.filter((file) => !existsSync(join(place, file)))).toEqual([]);
  });

  test('has README and licence, and no sources, tests or build files', () => {
    const files = globSync('**/*', { cwd: installed(name) });
    expect(files).toEqual(expect.arrayContaining(['LICENSE', 'README.md', 'package.json']));
    const stray = files.filter(
      (file) => !file.startsWith('dist') && !/^(LICENSE|NOTICE|README\.md|package\.json)$/.test(file),
    );
    expect(stray).toEqual([]);
    expect(files.filter((file) => /\.test\.|(?<!\.d)\.ts$|tsconfig/.test(file))).toEqual([]);
  });

  test('declares and bundles no private package', () => {
    const text = globSync('dist/**/*.{js,d.ts}', { cwd: installed(name) }).map((file) =>
      readFileSync(join(installed(name), file), 'utf8'),
    );
    const imported = text.flatMap((each) =>
      [...each.matchAll(/\b(?:from|import\()\s*["'](@farpoint\/[^"']+)["']/g)].map(([, from]) => from!),
    );
    expect(imported.filter((each) => !names.includes(each))).toEqual([]);
  });
});

test('the operator carries workers, WASM, and the licences of what it bundles', () => {
  const files = globSync('dist/*', { cwd: installed('@farpoint/operator') });
  expect(files).toEqual(
    expect.arrayContaining(
      ['cloud-worker.js', 'picture-worker.js', 'farpoint_codec_bg.wasm', 'THIRD_PARTY_LICENSES.txt'].map(
        (file) => join('dist', file),
      ),
    ),
  );
});

/** Uses types of both packages as somebody's page would; an expected error fails where a type has become `any`. */
const CONSUMER = `
import { CloudView, RobotWorld } from '@farpoint/cloud-view';
import { type ConnectError, connect, type RobotClient } from '@farpoint/operator';
import { Scene, WebGLRenderer } from 'three';

const robot: RobotClient = connect({ signaling: 'wss://robots.example.org', robot: 'rover-1' });
const view = new CloudView(new WebGLRenderer(), robot);
new Scene().add(new RobotWorld().add(view));
robot.on('telemetry', ({ pose }): number => pose.position.x);
robot.on('robots', ([first]) => first !== undefined && robot.choose(first.id));
export const reason = (error: ConnectError): 'bad-token' | null => (error.reason === 'bad-token' ? error.reason : null);
// @ts-expect-error: there is no such event
robot.on('weather', () => undefined);
// @ts-expect-error: a robot's id is text
robot.choose(1);
// @ts-expect-error: events are not any
robot.on('telemetry', (telemetry): string => telemetry);
`;

test.each([
  ['nodenext', 'nodenext'],
  ['esnext', 'bundler'],
])('types compile in a strict project, module %s, resolution %s', async (module, moduleResolution) => {
  const project = join(folder, moduleResolution);
  mkdirSync(project);
  writeFileSync(join(project, 'consumer.ts'), CONSUMER);
  writeFileSync(join(project, 'package.json'), JSON.stringify({ type: 'module' }));
  const lib = ['es2022', 'esnext.disposable', 'dom'];
  const compilerOptions = { module, moduleResolution, lib, target: 'es2022', types: [], noEmit: true };
  const config = {
    compilerOptions: { ...compilerOptions, strict: true, skipLibCheck: false },
    files: ['consumer.ts'],
  };
  writeFileSync(join(project, 'tsconfig.json'), JSON.stringify(config));
  expect((await run('tsc', ['-p', project])).output).toBe('');
});

const MOST_MS = 120_000;
const ROBOT = {
  id: 'own-1',
  name: 'Own robot',
  args: ['--sim-seed', '1', '--mode', 'points64', '--max-points', '6000'],
};

/** What the example's page exposes for this test. */
interface OwnPage {
  robot: {
    telemetry: {
      pose: { position: { x: number; y: number } };
      drive: string;
      twist: { linear: { x: number } };
    } | null;
    link: { session: { estop: { latched: boolean } } };
  };
  view: { drawn: number; frames: number };
}

describe.skipIf(findChromium() === null)(`needs Chromium: ${CHROMIUM_REMEDY}`, () => {
  test(
    'a page of somebody else’s shows a robot’s world, drives it and stops it',
    async () => {
      const folder = testFolder();
      await installOwnPage(folder, tarballs);
      expect(await typeFaults(folder, CONSUMER)).toBe('');
      const server = await serveFolder(folder);
      onTestFinished(() => server.close());
      const stack = await LocalStack.start({ robots: [ROBOT] });
      onTestFinished(() => stack.stop());
      const browser = await launchChromium();
      onTestFinished(() => browser.close());
      const page = await browser.newPage({ viewport: { width: 480, height: 270 } });
      const faults: string[] = [];
      page.on('pageerror', (error) => faults.push(String(error)));
      const address = new URL(server.url);
      address.searchParams.set('signaling', stack.signalingUrl);
      address.searchParams.set('robot', ROBOT.id);
      await page.goto(address.href);

      const view = () =>
        page.evaluate(() => {
          const { drawn, frames } = (globalThis as unknown as OwnPage).view;
          return { drawn, frames };
        });
      await eventually(async () => (await view()).drawn > 1000);
      const { frames } = await view();
      await eventually(async () => (await view()).frames > frames);

      const telemetry = () =>
        page.evaluate(() => {
          const { telemetry: newest } = (globalThis as unknown as OwnPage).robot;
          if (newest === null) return null;
          return { ...newest.pose.position, speed: newest.twist.linear.x, drive: newest.drive };
        });
      const start = await eventually(telemetry);
      await page.keyboard.down('KeyW');
      await eventually(async () => {
        const now = await telemetry();
        // After a gap, as a busy machine makes them, the robot waits for the hand to let go.
        if (now?.drive === 'watchdog') {
          await page.keyboard.up('KeyW');
          await eventually(async () => (await telemetry())?.drive !== 'watchdog');
          await page.keyboard.down('KeyW');
        }
        return Math.hypot((now?.x ?? 0) - start.x, (now?.y ?? 0) - start.y) > 0.2;
      });
      await page.keyboard.up('KeyW');
      await eventually(async () => (await telemetry())?.speed === 0);

      await page.locator('#stop').click();
      await eventually(() =>
        page.evaluate(() => (globalThis as unknown as OwnPage).robot.link.session.estop.latched),
      );
      expect(faults).toEqual([]);
    },
    MOST_MS,
  );
});
