import { type ConfigFile, readConfigFile } from './config-file.ts';
import { helpText, parseFlags } from './flags.ts';
import {
  type CommonValues,
  DEFAULT_CONFIG_PATH,
  environmentName,
  type OptionPlace,
  type OptionSpec,
  OptionsError,
  type OptionTable,
  type OptionValues,
  optionPlaces,
  type ProgramDefinition,
} from './option-table.ts';

/** Where a value came from, as error messages name it. */
export type OptionSource = 'flag' | 'environment' | 'config' | 'default';

export interface OptionInput {
  /** Without node and the script. */
  readonly argv: readonly string[];
  readonly env: Readonly<Record<string, string | undefined>>;
  /** The file's text, or `null` where there is none. Default: from disk. */
  readonly readFile?: (path: string) => string | null;
}

export type ResolvedOptions<Table extends OptionTable> =
  /** `--help` or `--version`: print and exit 0. */
  | { readonly action: 'print'; readonly text: string }
  | {
      readonly action: 'run';
      readonly values: OptionValues<Table> & CommonValues;
      readonly sources: Readonly<Record<string, OptionSource>>;
      /** The configuration file that was read, if any. */
      readonly configPath: string | null;
      /** Set variables that begin like this program's own and are none of them: typing mistakes, worth a warning. */
      readonly unknownEnvironment: readonly string[];
    };

/**
 * Takes each option from the first place that has it: flags, environment, configuration file, default.
 * An empty environment variable counts as unset.
 *
 * @throws {OptionsError} for an unknown flag, section or key, and for a value its schema refuses
 */
export function resolveOptions<Table extends OptionTable>(
  definition: ProgramDefinition<Table>,
  input: OptionInput,
): ResolvedOptions<Table> {
  const places = optionPlaces(definition);
  const flags = parseFlags(definition, places, input.argv);
  if (flags.action === 'help') return { action: 'print', text: helpText(definition, places) };
  if (flags.action === 'version')
    return { action: 'print', text: `${definition.name} ${definition.version}\n` };

  const values: Record<string, unknown> = {};
  const sources: Record<string, OptionSource> = {};
  const take = (place: OptionPlace, file: ConfigFile | null): void => {
    const { key, spec } = place;
    const fromEnv = place.env === null ? undefined : input.env[place.env];
    let source: OptionSource = 'default';
    let where = '';
    let raw: unknown;
    if (flags.values.has(key)) {
      [source, where, raw] = ['flag', place.flag ?? key, flags.values.get(key)];
    } else if (fromEnv !== undefined && fromEnv !== '') {
      [source, where, raw] = ['environment', place.env ?? key, fromEnv];
    } else if (file !== null && Object.hasOwn(file.section, key)) {
      [source, where, raw] = ['config', `${file.path}: ${definition.section}.${key}`, file.section[key]];
    }
    sources[key] = source;
    values[key] = source === 'default' ? spec.default : check(spec, where, raw);
  };

  const config = places.find((place) => place.key === 'config')!;
  take(config, null);
  const file = readConfigFile(
    (values.config as string | null) ?? DEFAULT_CONFIG_PATH,
    {
      section: definition.section,
      keys: places.filter((place) => place !== config).map((place) => place.key),
      mustExist: values.config !== null,
      source: sources.config === 'flag' ? config.flag! : config.env!,
    },
    input.readFile,
  );
  for (const place of places) if (place !== config) take(place, file);

  const prefix = environmentName(definition.section, '');
  const known = new Set(places.map((place) => place.env));
  return {
    action: 'run',
    values: values as OptionValues<Table> & CommonValues,
    sources,
    configPath: file?.path ?? null,
    unknownEnvironment: Object.keys(input.env).filter((name) => name.startsWith(prefix) && !known.has(name)),
  };
}

function check(spec: OptionSpec, where: string, raw: unknown): unknown {
  const parsed = spec.schema.safeParse(raw);
  if (parsed.success) return parsed.data;
  const issue = parsed.error.issues[0]!;
  const path = issue.path.length === 0 ? '' : `.${issue.path.map(String).join('.')}`;
  throw new OptionsError(`${where}${path}`, `${issue.message}${spec.secret ? '' : `, not ${shown(raw)}`}`);
}

function shown(value: unknown): string {
  const json = JSON.stringify(value) ?? String(value);
  return json.length > 80 ? `${json.slice(0, 77)}…` : json;
}
