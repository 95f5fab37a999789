import { devNull } from 'node:os';
import { type Document, isAlias, isMap, isScalar, LineCounter, type Node, parseDocument } from 'yaml';
import { closest, closestKey } from './closest.ts';
import { type OptionMistake, OptionsError } from './option-errors.ts';
import { configSections } from './option-table.ts';
import { readTextFile, TextFileError } from './text-file.ts';

type Path = readonly (string | number)[];

/** One program's section of the configuration file. */
export interface ConfigFile {
  readonly path: string;
  /** Values by dotted key within the section. */
  readonly values: ReadonlyMap<string, unknown>;
  /** The same, with each number and word as text, as it is written: YAML reads 00123 as 123. */
  readonly written: ReadonlyMap<string, unknown>;
  /** Location of a key, or of something inside its value, for error messages. */
  place(key: string, inside?: Path): { where: string; file: string; line: number; key: string };
}

interface Expected {
  section: string;
  /** Dotted, for example `limits.maxLinear`. */
  keys: readonly string[];
  mustExist: boolean;
  /** The flag or variable that named the file. */
  source: string;
}

/**
 * Reads one program's section of a configuration file: YAML, a mapping from program to its options, in groups.
 *
 * @param mistakes gets a sentence for every unknown section or key; the rest is still read
 * @returns null if there is no such file and none was requested
 * @throws {OptionsError} if the file is missing, empty, or not YAML
 */
export function readConfigFile(
  path: string,
  expected: Expected,
  mistakes: OptionMistake[],
  readFile: (path: string) => string | null = readFromDisk,
): ConfigFile | null {
  const content = readFile(path);
  if (content === null) {
    if (!expected.mustExist) return null;
    throw new OptionsError(expected.source, `names a file that does not exist: ${path}`);
  }
  const source = parseYaml(path, content);
  const values = new Map<string, unknown>();
  const written = new Map<string, unknown>();
  const file: ConfigFile = {
    path,
    values,
    written,
    place: (key, inside = []) => source.place([expected.section, ...key.split('.'), ...inside]),
  };
  const { root } = source;
  if (root === null || root === undefined) return file;
  if (!isMapping(root)) {
    mistakes.push({ ...source.place([]), detail: 'must be a mapping from program to options' });
    return file;
  }
  for (const name of Object.keys(root)) {
    if ((configSections as readonly string[]).includes(name)) continue;
    const detail = `is not a section${closest(name, configSections)}; the sections are ${configSections.join(', ')}`;
    mistakes.push({ ...source.place([name]), detail });
  }
  collect(root[expected.section], source.written(expected.section), '');
  return file;

  function collect(node: unknown, asText: unknown, group: string): void {
    if (node === null || node === undefined) return;
    if (!isMapping(node)) {
      const path = group === '' ? [expected.section] : [expected.section, ...group.split('.')];
      mistakes.push({ ...source.place(path), detail: 'must be a mapping from option to value' });
      return;
    }
    for (const [name, value] of Object.entries(node)) {
      const key = group === '' ? name : `${group}.${name}`;
      const text = isMapping(asText) ? asText[name] : undefined;
      if (expected.keys.includes(key)) {
        values.set(key, value);
        written.set(key, text);
      } else if (expected.keys.some((known) => known.startsWith(`${key}.`))) collect(value, text, key);
      else {
        const place = source.place([expected.section, ...(group === '' ? [] : group.split('.')), name]);
        const hint = closestKey(group, name, expected.keys).replace('mean ', `mean ${expected.section}.`);
        mistakes.push({ ...place, detail: `is not an option${hint}` });
      }
    }
  }
}

interface ParsedYaml {
  readonly root: unknown;
  /** A section of the root, with all scalars as text. */
  written(section: string): unknown;
  place(path: Path): { where: string; file: string; line: number; key: string };
}

function parseYaml(file: string, content: string): ParsedYaml {
  const lines = new LineCounter();
  const document = parseDocument(content, { prettyErrors: false, lineCounter: lines });
  const mistakes = document.errors.map((error): OptionMistake => {
    const { line } = lines.linePos(error.pos[0]);
    return { where: `${file}:${line}:`, detail: `not valid YAML: ${firstLine(error)}`, file, line };
  });
  if (mistakes.length > 0) throw new OptionsError(mistakes);
  let root: unknown;
  try {
    root = document.toJS();
  } catch (error) {
    // Aliases are resolved only by toJS, which throws if one points nowhere or there are too many.
    throw new OptionsError([{ where: `${file}:`, detail: `not valid YAML: ${firstLine(error)}`, file }]);
  }
  return {
    root,
    written(section) {
      const all: unknown = parseDocument(content, { prettyErrors: false, schema: 'failsafe' }).toJS();
      return isMapping(all) ? all[section] : undefined;
    },
    place(path) {
      const { line } = lines.linePos(offsetOf(document, path));
      const key = path.join('.');
      return { where: `${file}:${line}:${key === '' ? '' : ` ${key}`}`, file, line: Math.max(1, line), key };
    },
  };
}

/** Where a key begins, or else the innermost existing key on the path to it. */
function offsetOf(document: Document.Parsed, path: Path): number {
  let node: unknown = document.contents;
  let offset = document.contents?.range[0] ?? 0;
  for (const step of path) {
    if (isAlias(node)) node = node.resolve(document);
    let next: unknown;
    if (isMap(node)) {
      const pair = node.items.find(({ key }) => String(isScalar(key) ? key.value : key) === String(step));
      if (pair === undefined) break;
      offset = (pair.key as Node).range?.[0] ?? offset;
      next = pair.value;
    } else if (typeof step === 'number' && typeof node === 'object' && node !== null && 'items' in node) {
      next = (node.items as unknown[])[step];
      offset = (next as Node | undefined)?.range?.[0] ?? offset;
    } else break;
    node = next;
  }
  return offset;
}

function firstLine(error: unknown): string {
  return (error as Error).message.split('\n')[0]?.replace(/:$/, '') ?? '';
}

function readFromDisk(path: string): string | null {
  // By it, people say that there is to be none.
  if (path === devNull) return '';
  try {
    return readTextFile(path);
  } catch (error) {
    if (!(error instanceof TextFileError)) throw error;
    if (error.code === 'ENOENT') return null;
    // Without its options a robot would have the limits of another.
    throw new OptionsError(path, error.code === null ? error.fault : error.message);
  }
}

function isMapping(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
