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

/** Declarations of a package without external dependencies must be complete. */
const STRICT = [
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
  const root = resolve(folder, '../..');
  const out = join(dist, 'types');
  const bundled = bundledIndexes(spec);
  emitDeclarations(folder, { root, out, bundled, config: join(dist, 'tsconfig.json') });
  const declarations = new Declarations(root, out, bundled);
  const index = declarations.place(join(folder, 'src/index.ts'));
  declarations.publish(index);
  declarations.removeUnpublished();
  for (const file of declarations.published)
    if (file.startsWith(dirname(index))) refuseHidden(file, declarations.hidden);
  if (external.length === 0) compile(folder, [...STRICT, index]);
}

interface DeclarationFolders {
  root: string;
  out: string;
  bundled: ReadonlyMap<string, string>;
  /** Where the compiler's configuration is, while it runs. */
  config: string;
}

function emitDeclarations(folder: string, { root, out, bundled, config }: DeclarationFolders): void {
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
}

/** The declarations that the compiler has made below one folder, as users of the package get them. */
class Declarations {
  readonly published = new Set<string>();
  /** Types whose contents users cannot see. */
  readonly hidden = new Set<string>();
  readonly #root: string;
  readonly #out: string;
  readonly #bundled: ReadonlyMap<string, string>;

  /** @param root of the workspace @param out where the compiler has put them @param bundled each package's index */
  constructor(root: string, out: string, bundled: ReadonlyMap<string, string>) {
    this.#root = root;
    this.#out = out;
    this.#bundled = bundled;
  }

  /** Where the declarations of a source file are. */
  place(source: string): string {
    return join(this.#out, relative(this.#root, source).replace(/\.ts$/, '.d.ts'));
  }

  /** Rewrites a declaration file, and all to which it refers. */
  publish(file: string): void {
    if (this.published.has(file)) return;
    this.published.add(file);
    // A declaration file that was written by hand.
    if (!existsSync(file)) {
      mkdirSync(dirname(file), { recursive: true });
      cpSync(join(this.#root, relative(this.#out, file)), file);
    }
    const { text, opaque } = publicDeclaration(readFileSync(file, 'utf8'), (name) =>
      this.#addressOf(name, file),
    );
    writeFileSync(file, text);
    for (const type of opaque) this.hidden.add(type);
    for (const path of references(text)) this.publish(join(dirname(file), path.replace(/\.js$/, '.d.ts')));
  }

  removeUnpublished(): void {
    for (const file of globSync('**/*.d.ts', { cwd: this.#out }).map((path) => join(this.#out, path))) {
      if (!this.published.has(file)) unlinkSync(file);
    }
  }

  /** The address of a package's declarations in a file; that of a package that is not bundled is its name. */
  #addressOf(name: string, file: string): string {
    const index = this.#bundled.get(name);
    return index === undefined
      ? name
      : `./${relative(dirname(file), this.place(index)).replace(/\.d\.ts$/, '.js')}`;
  }
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
