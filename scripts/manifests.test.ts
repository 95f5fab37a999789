/** Every package.json says the same kind of things: one version for all, one licence, ES modules, the Node it needs. */
import { describe, expect, test } from 'vitest';
import { publishedPackages } from './lib/published-packages.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

const manifests = files
  .filter((file) => /(^|\/)package\.json$/.test(file) && !file.includes('/fixtures/'))
  .map((file) => ({ file, manifest: JSON.parse(read(file)) as Record<string, unknown> }));
const { version } = manifests.find(({ file }) => file === 'package.json')!.manifest;
const published = publishedPackages.map(({ folder }) => `${folder}/package.json`);

/** Node that runs TypeScript as it is. */
const PROGRAMS = '>=22.18';
/** What is built before it runs: the published packages, and what needs Node only to fetch pnpm. */
const ANYWHERE = '>=18';
const BUILT = ['package.json', 'examples/own-page/package.json', ...published];

describe.each(manifests)('$file', ({ file, manifest }) => {
  test('has a description, the licence, ES modules and engines', () => {
    expect(manifest.description).toMatch(/^[A-Z].*\.$/);
    expect(manifest).toMatchObject({
      license: 'Apache-2.0',
      type: 'module',
      engines: { node: BUILT.includes(file) ? ANYWHERE : PROGRAMS },
    });
  });

  test('is private unless it is published', () => {
    expect(manifest.private).toBe(published.includes(file) ? undefined : true);
  });

  test.skipIf(file.startsWith('examples/'))('has the version of all', () => {
    expect(manifest.version).toBe(version);
  });
});
