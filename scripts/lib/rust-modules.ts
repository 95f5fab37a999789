/** Finds which source files of a Rust crate use which others. */
import { parseRust, type RustImport, type RustModule } from './rust-source.ts';

/** Limit for chains of aliases, far above what a crate has. */
const MAX_ALIASES = 8;

interface Module {
  /** Path segments from the crate's root. */
  path: readonly string[];
  file: string;
  content: RustModule;
}

/**
 * The files that each file of a crate uses: those that define what its `use` lines and paths name. A re-export (`pub
 * use`) is an alias: code that names it uses the file that defines the item. So does a file whose own code names what
 * it re-exports. Declaring a module (`mod name;`) does not count as use.
 *
 * @param sources text of every file by its path below the crate's root, with `/`: `lib.rs`, `rans/mod.rs`
 */
export function rustFileGraph(sources: ReadonlyMap<string, string>): Map<string, Set<string>> {
  const modules = new Map<string, Module>();
  for (const [file, text] of sources) addModule(modules, pathOf(file), file, parseRust(text));
  const graph = new Map([...sources.keys()].map((file) => [file, new Set<string>()]));
  for (const module of modules.values()) {
    const { imports, names, paths } = module.content;
    const isUse = ({ exported, name }: RustImport) => !exported || names.has(name);
    const used = [...imports.filter(isUse).map(({ path }) => path), ...paths];
    for (const path of used)
      for (const file of filesOf(modules, module, path))
        if (file !== module.file) graph.get(module.file)?.add(file);
  }
  return graph;
}

/** `lib.rs` → [], `rans/mod.rs` and `rans.rs` → [rans], `rans/decoder.rs` → [rans, decoder]. */
function pathOf(file: string): string[] {
  const parts = file.replace(/\.rs$/, '').split('/');
  const isRoot = parts.length === 1 && (parts[0] === 'lib' || parts[0] === 'main');
  return isRoot || parts.at(-1) === 'mod' ? parts.slice(0, -1) : parts;
}

function addModule(modules: Map<string, Module>, path: string[], file: string, content: RustModule): void {
  modules.set(path.join('::'), { path, file, content });
  for (const [name, inline] of content.inline) addModule(modules, [...path, name], file, inline);
}

/** The files that define what a path inside a module names; none for items of other crates and of the language. */
function filesOf(
  modules: ReadonlyMap<string, Module>,
  from: Module,
  path: readonly string[],
  aliases = 0,
): string[] {
  const [first = '', ...rest] = path;
  const at = (segments: readonly string[]) => modules.get(segments.join('::'));
  if (first === 'crate') return within(at([]), rest);
  if (first === 'self') return within(from, rest);
  if (first === 'super') return within(at(from.path.slice(0, -1)), rest);
  const isKnown = at([...from.path, first]) !== undefined || importsOf(from, first).length > 0;
  return isKnown ? within(from, path) : [];

  /** Follows a path from its starting module. */
  function within(module: Module | undefined, segments: readonly string[]): string[] {
    const [name, ...others] = segments;
    if (module === undefined) return [];
    if (name === undefined) return [module.file];
    if (name === 'super') return within(at(module.path.slice(0, -1)), others);
    const child = at([...module.path, name]);
    if (child !== undefined) return within(child, others);
    const imports = importsOf(module, name);
    if (imports.length === 0 || aliases === MAX_ALIASES) return [module.file];
    return imports.flatMap((alias) => filesOf(modules, module, [...alias, ...others], aliases + 1));
  }
}

/** What a name means in a module; several paths if it depends on the target. */
function importsOf(module: Module, name: string): string[][] {
  return module.content.imports.filter((each) => each.name === name).map(({ path }) => path);
}
