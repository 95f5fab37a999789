import * as z from 'zod';
import { type ConfigFile, readConfigFile } from './config-file.ts';
import { helpText, parseFlags } from './flags.ts';
import { type OptionMistake, throwMistakes } from './option-errors.ts';
import { valueIssues } from './option-issues.ts';
import {
  type CommonValues,
  DEFAULT_CONFIG_PATH,
  environmentName,
  type OptionPlace,
  type OptionTable,
  type OptionValues,
  optionPlaces,
  type ProgramDefinition,
} from './option-table.ts';

/** The source of a value, as named in error messages. */
export type OptionSource = 'flag' | 'environment' | 'config' | 'default';

export interface OptionInput {
  /** Without node and the script. */
  readonly argv: readonly string[];
  readonly env: Readonly<Record<string, string | undefined>>;
  /** Returns the file's text, or `null` if it does not exist. Default: from disk. */
  readonly readFile?: (path: string) => string | null;
}

export type ResolvedOptions<Table extends OptionTable> =
  /** `--help` or `--version`: print and exit 0. */
  | { readonly action: 'print'; readonly text: string }
  | {
      readonly action: 'run';
      readonly values: OptionValues<Table> & CommonValues;
      readonly sources: Readonly<Record<string, OptionSource>>;
      /** How messages name the source of a value: its flag, variable, or line of the file. */
      readonly where: (key: keyof Table & string) => string;
      /** The configuration file that was read, if any. */
      readonly configPath: string | null;
      /** Environment variables with this program's prefix that name no option: typing mistakes, worth a warning. */
      readonly unknownEnvironment: readonly string[];
    };

/**
 * Takes each option from the first source that has it: flags, environment, configuration file, default. An empty
 * environment variable counts as unset.
 *
 * @throws {OptionsError} with every unknown section or key, and every value that its schema refuses; for an unknown
 * flag, only that
 */
export function resolveOptions<Table extends OptionTable>(
  definition: ProgramDefinition<Table>,
  input: OptionInput,
): ResolvedOptions<Table> {
  const places = optionPlaces(definition);
  const flags = parseFlags(definition, places, input.argv);
  if (flags.action === 'help') return { action: 'print', text: helpText(definition, places, flags.of) };
  if (flags.action === 'version')
    return { action: 'print', text: `${definition.name} ${definition.version}\n` };

  const mistakes: OptionMistake[] = [];
  const values: Record<string, unknown> = {};
  const sources: Record<string, OptionSource> = {};
  const take = (place: OptionPlace, file: ConfigFile | null): void => {
    const { key, spec } = place;
    const given = findValue(place, flags.values, input.env, file);
    sources[key] = given?.source ?? 'default';
    if (given === null) {
      values[key] = spec.default;
      return;
    }
    const parsed = parseValue(spec.schema, given);
    if (parsed.success) values[key] = parsed.data;
    else mistakes.push(...valueMistakes(place, given, parsed.error, file));
  };

  const config = places.find((place) => place.key === 'config')!;
  take(config, null);
  throwMistakes(mistakes);
  const file = readConfigFile(
    (values.config as string | null) ?? DEFAULT_CONFIG_PATH,
    {
      section: definition.section,
      keys: places.map((place) => place.file).filter((key) => key !== null),
      mustExist: values.config !== null,
      source: sources.config === 'flag' ? config.flag! : config.env!,
    },
    mistakes,
    input.readFile,
  );
  for (const place of places) if (place !== config) take(place, file);
  throwMistakes(mistakes);

  const prefix = environmentName(definition.section, '');
  const known = new Set(places.map((place) => place.env));
  return {
    action: 'run',
    values: values as OptionValues<Table> & CommonValues,
    sources,
    where: (key) =>
      whereIs(places.find((place) => place.key === key)!, sources[key]!, file, definition.section),
    configPath: file?.path ?? null,
    unknownEnvironment: Object.keys(input.env).filter((name) => name.startsWith(prefix) && !known.has(name)),
  };
}

interface GivenValue {
  source: Exclude<OptionSource, 'default'>;
  raw: unknown;
  /** Of the file: the same with all numbers as text. */
  written?: unknown;
}

function findValue(
  place: OptionPlace,
  flags: ReadonlyMap<string, unknown>,
  environment: OptionInput['env'],
  file: ConfigFile | null,
): GivenValue | null {
  if (flags.has(place.key)) return { source: 'flag', raw: flags.get(place.key) };
  const variable = place.env === null ? undefined : environment[place.env];
  if (variable !== undefined && variable !== '') return { source: 'environment', raw: variable };
  if (place.file !== null && file?.values.has(place.file))
    return {
      source: 'config',
      raw: file.values.get(place.file),
      written: file.written.get(place.file),
    };
  return null;
}

/** Where text is meant, a number counts as it is written: the token 00123 is not 123. */
function parseValue(schema: z.core.$ZodType, { raw, written }: GivenValue): z.ZodSafeParseResult<unknown> {
  const parsed = z.safeParse(schema, raw);
  if (written === undefined) return parsed;
  const text = z.safeParse(schema, withTexts(raw, written, parsed.success ? parsed.data : ''));
  return text.success ? text : parsed;
}

/** The value with the texts that are written in place of numbers that were read as texts. */
function withTexts(raw: unknown, written: unknown, read: unknown): unknown {
  if (Array.isArray(raw) && Array.isArray(written))
    return raw.map((each, i) => withTexts(each, written[i], Array.isArray(read) ? read[i] : read));
  const isWord = typeof raw === 'number' || typeof raw === 'bigint' || typeof raw === 'boolean';
  return isWord && typeof read === 'string' && typeof written === 'string' ? written : raw;
}

function valueMistakes(
  place: OptionPlace,
  { source, raw }: GivenValue,
  error: z.ZodError,
  file: ConfigFile | null,
): OptionMistake[] {
  return valueIssues(place.spec.schema, error, raw).map(({ inside, detail, found }) => {
    const name = (source === 'flag' ? place.flag : place.env) ?? place.key;
    const key = [name, ...inside].join('.');
    return {
      ...(source === 'config' && file !== null && place.file !== null
        ? file.place(place.file, inside)
        : { where: key, key }),
      detail,
      ...(place.spec.secret || found === undefined ? {} : { found: shown(found) }),
    };
  });
}

function whereIs(place: OptionPlace, source: OptionSource, file: ConfigFile | null, section: string): string {
  const { flag, env, file: key } = place;
  if (source === 'environment') return env!;
  if (source === 'config') return file!.place(key!).where;
  if (source === 'flag' || file === null || key === null) return flag ?? `${section}.${key}`;
  // No source has it: name both ways to set it.
  return flag === null ? `${file.path}: ${section}.${key}` : `${flag} (or ${section}.${key} in ${file.path})`;
}

function shown(value: unknown): string {
  const json = JSON.stringify(value) ?? String(value);
  return json.length > 80 ? `${json.slice(0, 77)}…` : json;
}
