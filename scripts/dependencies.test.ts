/**
 * Checks that a package declares everything it imports, and uses everything it declares. Otherwise it works by luck,
 * or installs things that nobody needs.
 */
import { dirname, join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { parse } from 'yaml';
import * as z from 'zod';
import { importedPackages } from './lib/package-imports.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

const record = z.record(z.string(), z.string()).default({});
const manifestSchema = z.object({
  name: z.string(),
  dependencies: record,
  devDependencies: record,
  peerDependencies: record,
  scripts: record,
  /** Present in published packages. Their imports of our own packages are bundled. */
  publishConfig: z.object({}).optional(),
});

const tsconfigSchema = z.object({ references: z.array(z.object({ path: z.string() })) });

const packages = files
  .filter((file) => /(^|\/)package\.json$/.test(file) && !file.includes('/fixtures/'))
  .map((file) => ({ folder: dirname(file), ...manifestSchema.parse(JSON.parse(read(file))) }));
/** The innermost package that contains a file. */
const ownerOf = (file: string) =>
  packages
    .filter(({ folder }) => folder === '.' || file.startsWith(`${folder}/`))
    .reduce((best, each) => (each.folder.length >= best.folder.length || best.folder === '.' ? each : best));

const SOURCE = /\.(?:ts|tsx|mts|js|mjs|cjs)$/;
/** Files that run only in tests, benchmarks and builds, for which devDependencies are enough. */
const FOR_DEVELOPERS =
  /^(?:bench|e2e|scripts)\/|\.test\.ts$|\/(?:testing|deploy)\/|(?:\.config|^[^/]*|\/build)\.ts$/;
/** Their texts contain imports that they do not make themselves. */
const EXAMPLES = [
  'scripts/lib/package-imports.test.ts',
  'scripts/lib/file-imports.test.ts',
  'scripts/lib/import-graph.test.ts',
  'scripts/published-packages.stack.test.ts',
];
const sources = files.filter(
  (file) => SOURCE.test(file) && !/(^|\/)(?:pkg|dist)\//.test(file) && !EXAMPLES.includes(file),
);
const byPackage = new Map(packages.map((each) => [each.name, [] as { file: string; text: string }[]]));
for (const file of sources) byPackage.get(ownerOf(file).name)!.push({ file, text: read(file) });

/** The test runner and its helper, which the tests of every package find in the workspace's root. */
const EVERYWHERE = new Set(['vitest', 'fast-check']);
/** Ambient types, which a tsconfig.json names instead of an import. */
const TYPES_OF_THE_PLATFORM = new Set(['@types/node', '@types/webxr']);
/** Programs whose names differ from their packages'. */
const PROGRAMS: Readonly<Record<string, string>> = { '@biomejs/biome': 'biome', typescript: 'tsc' };
/** Peer dependencies that only a tool needs; nothing of ours imports them. */
const ASKED_FOR: Readonly<Record<string, readonly string[]>> = { '@farpoint/api-pages': ['typescript'] };
/** Packages from the user's own installation, named by configuration. */
const FOREIGN = new Set(['rclnodejs']);

describe.each(packages)('$name', (manifest) => {
  const own = byPackage.get(manifest.name)!;
  const declared = {
    ...manifest.devDependencies,
    ...manifest.peerDependencies,
    ...manifest.dependencies,
  };

  test('declares what it imports', () => {
    const missing = own.flatMap(({ file, text }) => {
      const developers = manifest.publishConfig !== undefined || FOR_DEVELOPERS.test(file);
      return [...importedPackages(text)]
        .filter((name) => name !== manifest.name && !FOREIGN.has(name))
        .filter((name) => {
          if (!developers) return !(name in manifest.dependencies || name in manifest.peerDependencies);
          return !(name in declared || EVERYWHERE.has(name));
        })
        .map((name) => `${file}: ${name}`);
    });
    expect(missing).toEqual([]);
  });

  test.skipIf(!files.includes(`${manifest.folder}/tsconfig.json`) || manifest.folder === '.')(
    'is compiled after what it declares',
    () => {
      const { references } = tsconfigSchema.parse(JSON.parse(read(`${manifest.folder}/tsconfig.json`)));
      const folders = references.map(({ path }) => join(manifest.folder, path).replaceAll('\\', '/'));
      const ours = packages.filter(({ name, folder }) => name in declared && folder !== '.');
      // The scripts are no package.
      expect(folders.filter((folder) => folder !== 'scripts').sort()).toEqual(
        ours.map(({ folder }) => folder).sort(),
      );
    },
  );

  test('uses what it declares', () => {
    const imported = new Set(own.flatMap(({ text }) => [...importedPackages(text)]));
    const scripts = Object.values(manifest.scripts).join('\n');
    const unused = Object.keys(declared).filter((name) => {
      if (imported.has(name) || ASKED_FOR[manifest.name]?.includes(name)) return false;
      // Type packages are used by whoever uses the package that they describe.
      const typed = /^@types\/(?<of>.+)$/.exec(name)?.groups?.of?.replace('__', '/');
      if (typed !== undefined) {
        const described = typed.includes('/') ? `@${typed}` : typed;
        return !(imported.has(described) || TYPES_OF_THE_PLATFORM.has(name));
      }
      return !new RegExp(`(^|\\s)${PROGRAMS[name] ?? name}(\\s|$)`, 'm').test(scripts);
    });
    expect(unused).toEqual([]);
  });
});

test('every version in the catalog is used by a package', () => {
  const { catalog } = z.object({ catalog: record }).parse(parse(read('pnpm-workspace.yaml')));
  const used = new Set(
    packages.flatMap(({ dependencies, devDependencies }) =>
      Object.entries({ ...devDependencies, ...dependencies })
        .filter(([, version]) => version === 'catalog:')
        .map(([name]) => name),
    ),
  );
  expect(Object.keys(catalog).filter((name) => !used.has(name))).toEqual([]);
});
