/** Which files of the workspace a file needs to run, through all that it imports. Pure. */
import { posix } from 'node:path';

/** `from '…'`, `import '…'`, `import('…')` of the workspace's own files. */
const IMPORTS =
  /(?:\bfrom|^\s*import|\bimport\()\s*['"](?<specifier>(?:\.{1,2}\/|@farpoint\/)[^'"\n]+)['"]/gm;
/** A program, or a thread. */
const STARTED = /\bnew URL\(\s*['"](?<specifier>[\w./-]+\.(?:ts|js|mjs))['"]/g;
const COMMENTS = /\/\*[\s\S]*?\*\/|^\s*\/\/.*$/gm;
const TEST = /\.(?:test|page|spec|smoke)\.ts$/;

/** A workspace's package, and what its names stand for. */
export interface ExportingPackage {
  folder: string;
  name: string;
  /** `exports` of its `package.json`. */
  exports: Readonly<Record<string, unknown>>;
}

export class ImportGraph {
  readonly #files: ReadonlySet<string>;
  readonly #packages: ReadonlyMap<string, ExportingPackage>;
  readonly #read: (file: string) => string;
  readonly #imports = new Map<string, readonly string[]>();

  /** @param files all of the workspace @param read the text of one of them */
  constructor(
    files: readonly string[],
    packages: readonly ExportingPackage[],
    read: (file: string) => string,
  ) {
    this.#files = new Set(files);
    this.#packages = new Map(packages.map((each) => [each.name, each]));
    this.#read = read;
  }

  /** The file itself and all that it imports, through others as well; sorted. */
  closureOf(file: string): string[] {
    const closure = new Set([file]);
    for (const each of closure) for (const imported of this.#importsOf(each)) closure.add(imported);
    return [...closure].sort();
  }

  /** How many imports lie between a file and the nearest of these. Files that need none of them are not there. */
  distancesTo(files: Iterable<string>): ReadonlyMap<string, number> {
    const importers = new Map<string, string[]>();
    for (const file of this.#files) {
      for (const imported of this.#importsOf(file)) {
        const known = importers.get(imported);
        if (known === undefined) importers.set(imported, [file]);
        else known.push(file);
      }
    }
    const distances = new Map([...files].map((file) => [file, 0]));
    // A map is walked in the order of its entries, those added meanwhile as well: the nearest come first.
    for (const [file, distance] of distances)
      for (const importer of importers.get(file) ?? [])
        if (!distances.has(importer)) distances.set(importer, distance + 1);
    return distances;
  }

  #importsOf(file: string): readonly string[] {
    const known = this.#imports.get(file);
    if (known !== undefined) return known;
    const found = new Set<string>();
    if (/\.(?:ts|js|mjs)$/.test(file)) {
      const text = this.#read(file).replace(COMMENTS, '');
      for (const pattern of [IMPORTS, STARTED])
        for (const { groups } of text.matchAll(pattern))
          for (const each of this.#filesOf(file, groups?.specifier ?? '')) found.add(each);
    }
    const imports = [...found];
    this.#imports.set(file, imports);
    return imports;
  }

  #filesOf(file: string, specifier: string): string[] {
    if (!specifier.startsWith('@farpoint/')) {
      const path = posix.normalize(posix.join(posix.dirname(file), specifier.replace(/\?.*$/, '')));
      return this.#files.has(path) ? [path] : [];
    }
    const [scope, name, ...rest] = specifier.split('/');
    const used = this.#packages.get(`${scope}/${name}`);
    if (used === undefined) return [];
    const target = targetOf(used.exports[['.', ...rest].join('/')]);
    const path = target === null ? null : posix.join(used.folder, target);
    if (path !== null && this.#files.has(path)) return [path];
    // Where it is not known which of its files is meant, it may be any.
    return [...this.#files].filter((each) => each.startsWith(`${used.folder}/src/`) && !TEST.test(each));
  }
}

/** The file that an entry of `exports` stands for in the workspace. */
function targetOf(entry: unknown): string | null {
  if (typeof entry === 'string') return entry;
  if (typeof entry !== 'object' || entry === null) return null;
  for (const value of Object.values(entry)) {
    const target = targetOf(value);
    if (target?.endsWith('.ts') && !target.endsWith('.d.ts')) return target;
  }
  return null;
}
