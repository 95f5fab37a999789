/**
 * Builds a package of this workspace into what `pnpm pack` puts into its tarball: ES modules with their workers and
 * WASM, and type declarations. Private packages of the workspace are bundled, so that the tarball can be installed
 * alone.
 */
import { spawnSync } from 'node:child_process';
import {
  cpSync,
  existsSync,
  globSync,
  mkdirSync,
  readFileSync,
  realpathSync,
  rmSync,
  unlinkSync,
  writeFileSync,
} from 'node:fs';
import { basename, dirname, join, relative, resolve } from 'node:path';
import { build } from 'esbuild';
import { bundledPackages, licenceTexts } from './bundled-licences.ts';
import { publicDeclaration, references } from './declarations.ts';

export interface BrowserPackage {
  /** The package's folder. */
  folder: string;
  /** Modules with their own address, below `src`: the package's entry points and its workers. */
  entries: readonly string[];
  /** Packages that the built modules import by name. All other workspace packages are bundled. */
  external?: readonly string[];
  /** Files that the modules load at run time, relative to the package's folder. */
  assets?: readonly string[];
}

/** @throws {Error} with the compiler's message */
export async function buildBrowserPackage(spec: BrowserPackage): Promise<void> {
  const dist = join(spec.folder, 'dist');
  rmSync(dist, { recursive: true, force: true });
  mkdirSync(dist);
  await bundle(spec, dist);
  for (const asset of spec.assets ?? []) cpSync(join(spec.folder, asset), join(dist, basename(asset)));
  declare(spec, dist);
}

async function bundle({ folder, entries, external = [] }: BrowserPackage, dist: string): Promise<void> {
  const { metafile } = await build({
    absWorkingDir: folder,
    metafile: true,
    entryPoints: Object.fromEntries(entries.map((entry) => [basename(entry, '.ts'), `src/${entry}`])),
    outdir: dist,
    bundle: true,
    splitting: true,
    chunkNames: 'chunk-[hash]',
    format: 'esm',
    target: 'es2022',
    sourcemap: true,
    legalComments: 'inline',
    external: [...external],
    plugins: [
      {
        // All modules are in one folder, so what they look for beside themselves must be there, too.
        name: 'assets-beside',
        setup: ({ onLoad }) =>
          onLoad({ filter: /\.[jt]s$/ }, ({ path }) => {
            const text = readFileSync(path, 'utf8');
            if (!text.includes('import.meta.url')) return null;
            const contents = text.replace(
              /new URL\('([^']+)', import\.meta\.url\)/g,
              (_, file: string) => `new URL('./${basename(file).replace(/\.ts$/, '.js')}', import.meta.url)`,
            );
            return { contents, loader: path.endsWith('.ts') ? 'ts' : 'js' };
          }),
      },
    ],
  });
  const licences = licenceTexts(bundledPackages(Object.keys(metafile.inputs)), folder);
  if (licences !== null) writeFileSync(join(dist, 'THIRD_PARTY_LICENSES.txt'), licences);
}

/** The index of each bundled package by name: the workspace packages in `devDependencies`. */
function bundledIndexes({ folder, external = [] }: BrowserPackage): Map<string, string> {
  const { devDependencies = {} } = readManifest(folder);
  const names = Object.keys(devDependencies).filter(
    (name) => devDependencies[name] === 'workspace:*' && !external.includes(name),
  );
  return new Map(
    names.map((name) => {
      const found = realpathSync(join(folder, 'node_modules', name));
      return [name, join(found, readManifest(found).exports?.['.'] ?? 'index.ts')];
    }),
  );
}

interface Manifest {
  devDependencies?: Record<string, string>;
  exports?: Record<string, string>;
}

/** Reads a manifest of our own. */
function readManifest(folder: string): Manifest {
  return JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as Manifest;
}

function declare(spec: BrowserPackage, dist: string): void {
  const { folder, external = [] } = spec;
  const out = join(dist, 'types');
  const root = resolve(folder, '../..');
  const bundled = bundledIndexes(spec);
  const config = join(dist, 'tsconfig.json');
  const compilerOptions = {
    composite: false,
    incremental: false,
    declaration: true,
    types: [],
    rootDir: root,
    outDir: out,
    tsBuildInfoFile: null,
    paths: Object.fromEntries([...bundled].map(([name, file]) => [name, [file]])),
  };
  // Bundled packages are roots as well: what the compiler reaches first through an external package, it declares not at all.
  const include = ['../src/index.ts', ...bundled.values()];
  writeFileSync(config, JSON.stringify({ extends: '../tsconfig.json', compilerOptions, include }));
  compile(folder, ['-p', config]);
  unlinkSync(config);
  const place = (file: string) => join(out, relative(root, file).replace(/\.ts$/, '.d.ts'));
  const reached = new Set<string>();
  const hidden = new Set<string>();
  const visit = (file: string): void => {
    if (reached.has(file)) return;
    reached.add(file);
    // A declaration file that was written by hand.
    if (!existsSync(file)) {
      mkdirSync(dirname(file), { recursive: true });
      cpSync(join(root, relative(out, file)), file);
    }
    const { text, opaque } = publicDeclaration(readFileSync(file, 'utf8'), (name) => {
      const index = bundled.get(name);
      return index === undefined
        ? name
        : `./${relative(dirname(file), place(index)).replace(/\.d\.ts$/, '.js')}`;
    });
    writeFileSync(file, text);
    for (const type of opaque) hidden.add(type);
    for (const path of references(text)) visit(join(dirname(file), path.replace(/\.js$/, '.d.ts')));
  };
  visit(place(join(folder, 'src/index.ts')));
  for (const file of globSync('**/*.d.ts', { cwd: out })) {
    if (!reached.has(join(out, file))) unlinkSync(join(out, file));
  }
  const own = dirname(place(join(folder, 'src/index.ts')));
  for (const file of reached) if (file.startsWith(own)) refuseHidden(file, hidden);
  // Declarations of a package without external dependencies must be complete.
  const strict = [
    '--ignoreConfig',
    '--noEmit',
    '--strict',
    '--module',
    'nodenext',
    '--lib',
    'es2024,dom,esnext.disposable',
    '--types',
    '',
  ];
  if (external.length === 0) compile(folder, [...strict, place(join(folder, 'src/index.ts'))]);
}

/** @throws {Error} if the package's own declarations name a type whose contents users cannot see */
function refuseHidden(file: string, hidden: ReadonlySet<string>): void {
  for (const [name] of readFileSync(file, 'utf8').matchAll(/\b[A-Z]\w+\b/g)) {
    if (hidden.has(name))
      throw new Error(`${file} names ${name}, which is inferred from a schema: declare it`);
  }
}

function compile(folder: string, args: readonly string[]): void {
  const { status, stdout } = spawnSync('tsc', args, { cwd: folder, encoding: 'utf8' });
  if (status !== 0) throw new Error(`the declarations of ${folder} cannot be made:\n${stdout}`);
}
