import type * as z from 'zod';
import { choice, optional, text } from './option-schemas.ts';

/** One option of a program. */
export interface OptionSpec<T = unknown> {
  /** Converts text or YAML to the value; see option-schemas.ts. Of zod or, as in the protocol package, of zod/mini. */
  readonly schema: z.core.$ZodType<T>;
  /** Used unchanged, without the schema. */
  readonly default: NoInfer<T>;
  readonly help: string;
  /** Name of the argument in `--help`, for example `MS`. Omit it for a boolean, which takes no argument. */
  readonly argument?: string;
  /** Default: the key in kebab case after `--`. `false`: no flag. */
  readonly flag?: `--${string}` | false;
  /** Default: `FARPOINT_<SECTION>_<KEY>`. `false`: not read from the environment. */
  readonly env?: string | false;
  /** Dotted key in the program's section of the configuration file. Default: the key. `false`: not read from a file. */
  readonly file?: string | false;
  /** Its value is never shown, neither in errors nor in help. */
  readonly secret?: boolean;
}

export type OptionTable = Readonly<Record<string, OptionSpec>>;

export type OptionValues<Table extends OptionTable> = {
  [Key in keyof Table]: z.output<Table[Key]['schema']>;
};

export interface ProgramDefinition<Table extends OptionTable> {
  /** As on the command line, for example `farpoint-signaling`. */
  readonly name: string;
  readonly summary: string;
  readonly version: string;
  /** Its section of the configuration file, which is also the second word of its environment variables. */
  readonly section: ConfigSection;
  readonly options: Table;
  /** The options of {@link options} by what they are for, as `--help all` lists them: heading to options. */
  readonly groups?: Readonly<Record<string, OptionTable>>;
  /** The options that `--help` shows; the rest is in `--help all`. Without it, `--help` shows them all. */
  readonly basics?: readonly string[];
  /** Its other commands, as `--help` lists them: name to description. */
  readonly commands?: Readonly<Record<string, string>>;
}

/** The sections of all programs: any other section is a typing mistake and refused. */
export const configSections = ['robot', 'signaling', 'issuer', 'bridge', 'web', 'link'] as const;
export type ConfigSection = (typeof configSections)[number];

export const DEFAULT_CONFIG_PATH = 'farpoint.yaml';

export const logLevels = ['trace', 'debug', 'info', 'warn', 'error', 'fatal', 'silent'] as const;
export const logFormats = ['auto', 'json', 'text'] as const;

/** Options that every program has. */
export const commonOptions = {
  config: defineOption({
    schema: optional(text()),
    default: null,
    argument: 'FILE',
    env: 'FARPOINT_CONFIG',
    file: false,
    help: `configuration file (YAML); ./${DEFAULT_CONFIG_PATH} is read if it exists`,
  }),
  logLevel: defineOption({
    schema: choice(logLevels),
    default: 'info',
    argument: 'LEVEL',
    env: 'FARPOINT_LOG_LEVEL',
    file: 'log.level',
    help: `lowest level to log: ${logLevels.join(', ')}`,
  }),
  logFormat: defineOption({
    schema: choice(logFormats),
    default: 'auto',
    argument: 'FORMAT',
    env: 'FARPOINT_LOG_FORMAT',
    file: 'log.format',
    help: 'json, text, or auto: text on a terminal, JSON elsewhere',
  }),
} satisfies OptionTable;
export type CommonValues = OptionValues<typeof commonOptions>;

/** Types one option: `default` must have the schema's output type. */
export function defineOption<T>(spec: OptionSpec<T>): OptionSpec<T> {
  return spec;
}

/** Puts options into a group of the configuration file: each key gets the group's name and a dot as prefix. */
export function optionGroup<const Table extends OptionTable>(group: string, table: Table): Table {
  const grouped = Object.entries(table).map(([key, spec]) => [
    key,
    spec.file === false ? spec : { ...spec, file: `${group}.${spec.file ?? key}` },
  ]);
  return Object.fromEntries(grouped) as Table;
}

type Intersection<Union> = (Union extends unknown ? (each: Union) => void : never) extends (
  all: infer All,
) => void
  ? All
  : never;
type Merged<Groups extends Readonly<Record<string, OptionTable>>> = {
  [Key in keyof Intersection<Groups[keyof Groups]>]: Intersection<Groups[keyof Groups]>[Key];
};

/** One table of the options of several groups, in their order. @throws {Error} if two groups have the same option */
export function mergeGroups<const Groups extends Readonly<Record<string, OptionTable>>>(
  groups: Groups,
): Merged<Groups> {
  const entries = Object.values(groups).flatMap((table) => Object.entries(table));
  const merged = Object.fromEntries(entries);
  const twice = entries.find(([key, spec]) => merged[key] !== spec);
  if (twice !== undefined) throw new Error(`two groups have the option ${twice[0]}`);
  return merged as Merged<Groups>;
}

/** Types a program's table. */
export function defineProgram<const Table extends OptionTable>(
  definition: ProgramDefinition<Table> & {
    readonly basics?: readonly (keyof Table | keyof typeof commonOptions)[];
  },
): ProgramDefinition<Table> {
  return definition;
}

/** An option with its names in each source. */
export interface OptionPlace {
  readonly key: string;
  readonly spec: OptionSpec;
  readonly flag: string | null;
  readonly env: string | null;
  /** Dotted, within the program's section of the configuration file. */
  readonly file: string | null;
}

/** Every option of a program, its own before the common ones. */
export function optionPlaces<Table extends OptionTable>(definition: ProgramDefinition<Table>): OptionPlace[] {
  const table: OptionTable = { ...definition.options, ...commonOptions };
  return Object.entries(table).map(([key, spec]) => ({
    key,
    spec,
    flag: spec.flag === false ? null : (spec.flag ?? `--${words(key).join('-').toLowerCase()}`),
    env: spec.env === false ? null : (spec.env ?? environmentName(definition.section, key)),
    file: spec.file === false ? null : (spec.file ?? key),
  }));
}

export function environmentName(section: string, key: string): string {
  return `FARPOINT_${section.toUpperCase()}_${words(key).join('_').toUpperCase()}`;
}

function words(key: string): string[] {
  return key.split(/(?=[A-Z])/);
}
