import { readFileSync } from 'node:fs';
import { parseDocument } from 'yaml';
import { closest } from './closest.ts';
import { configSections, OptionsError } from './option-table.ts';

/** One program's section of the configuration file. */
export interface ConfigFile {
  readonly path: string;
  readonly section: Readonly<Record<string, unknown>>;
}

interface Expected {
  section: string;
  keys: readonly string[];
  mustExist: boolean;
  /** Which flag or variable named the file. */
  source: string;
}

/**
 * Reads one program's section of a configuration file: a YAML mapping from program to a mapping from key to value.
 *
 * @returns null where there is no such file and none was asked for
 * @throws {OptionsError} where the file is missing, not YAML, or has a section or key that nobody knows
 */
export function readConfigFile(
  path: string,
  expected: Expected,
  readFile: (path: string) => string | null = readFromDisk,
): ConfigFile | null {
  const content = readFile(path);
  if (content === null) {
    if (!expected.mustExist) return null;
    throw new OptionsError(expected.source, `names a file that does not exist: ${path}`);
  }
  const root = parseYaml(path, content);
  if (root === null) return { path, section: {} };
  if (!isMapping(root)) throw new OptionsError(path, 'must be a mapping from program to options');
  for (const name of Object.keys(root)) {
    if (!(configSections as readonly string[]).includes(name)) {
      throw new OptionsError(
        `${path}: ${name}`,
        `is not a section${closest(name, configSections)}; the sections are ${configSections.join(', ')}`,
      );
    }
  }
  const section = root[expected.section] ?? {};
  if (!isMapping(section)) {
    throw new OptionsError(`${path}: ${expected.section}`, 'must be a mapping from option to value');
  }
  for (const key of Object.keys(section)) {
    if (!expected.keys.includes(key)) {
      throw new OptionsError(
        `${path}: ${expected.section}.${key}`,
        `is not an option${closest(key, expected.keys)}`,
      );
    }
  }
  return { path, section };
}

function parseYaml(path: string, content: string): unknown {
  const document = parseDocument(content, { prettyErrors: true });
  const fault = document.errors[0];
  try {
    if (fault !== undefined) throw fault;
    return document.toJS();
  } catch (error) {
    // Aliases are resolved only by toJS: one that points nowhere, or too many of them, throw there.
    const reason = (error as Error).message.split('\n')[0]?.replace(/:$/, '') ?? '';
    throw new OptionsError(path, `is not valid YAML: ${reason}`);
  }
}

function readFromDisk(path: string): string | null {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return null;
    throw new OptionsError(path, `cannot be read: ${(error as Error).message}`);
  }
}

function isMapping(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
