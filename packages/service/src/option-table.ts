import type * as z from 'zod';
import { choice, optional, text } from './option-schemas.ts';

/** One option of a program. Its key in the table is its key in the configuration file. */
export interface OptionSpec<T = unknown> {
  /** From text or YAML to the value; see option-schemas.ts. */
  readonly schema: z.ZodType<T>;
  /** Used as it is: not run through the schema. */
  readonly default: NoInfer<T>;
  readonly help: string;
  /** Name of the argument in `--help`, e.g. `MS`. Leave out for a boolean, which takes none. */
  readonly argument?: string;
  /** Default: the key as kebab-case after `--`. `false`: no flag. */
  readonly flag?: `--${string}` | false;
  /** Default: `FARPOINT_<SECTION>_<KEY>`. `false`: not from the environment. */
  readonly env?: string | false;
  /** Its value is never shown, neither in errors nor in help. */
  readonly secret?: boolean;
}

export type OptionTable = Readonly<Record<string, OptionSpec>>;

export type OptionValues<Table extends OptionTable> = {
  [Key in keyof Table]: z.output<Table[Key]['schema']>;
};

export interface ProgramDefinition<Table extends OptionTable> {
  /** As on the command line, e.g. `farpoint-signaling`. */
  readonly name: string;
  readonly summary: string;
  readonly version: string;
  /** Its section of the configuration file and the second word of its environment variables. */
  readonly section: ConfigSection;
  readonly options: Table;
}

/** Every program's section: a section that is none of these is a typing mistake and refused. */
export const configSections = ['robot', 'signaling', 'bridge', 'web', 'link'] as const;
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
    help: `configuration file (YAML); ./${DEFAULT_CONFIG_PATH} is read where there is one`,
  }),
  logLevel: defineOption({
    schema: choice(logLevels),
    default: 'info',
    argument: 'LEVEL',
    env: 'FARPOINT_LOG_LEVEL',
    help: `least level that is logged: ${logLevels.join(', ')}`,
  }),
  logFormat: defineOption({
    schema: choice(logFormats),
    default: 'auto',
    argument: 'FORMAT',
    env: 'FARPOINT_LOG_FORMAT',
    help: 'json, text, or auto: text on a terminal, JSON elsewhere',
  }),
} satisfies OptionTable;
export type CommonValues = OptionValues<typeof commonOptions>;

/** A mistake in flags, environment or configuration file: one sentence that names the place. Exit code 2. */
export class OptionsError extends Error {
  override readonly name = 'OptionsError';
  /** `--port`, `FARPOINT_SIGNALING_PORT` or `farpoint.yaml: signaling.port`. */
  readonly where: string;

  constructor(where: string, detail: string) {
    super(`${where} ${detail}`);
    this.where = where;
  }
}

/** Gives one option its type: `default` must be what the schema puts out. */
export function defineOption<T>(spec: OptionSpec<T>): OptionSpec<T> {
  return spec;
}

/** Gives a program's table its types. */
export function defineProgram<const Table extends OptionTable>(
  definition: ProgramDefinition<Table>,
): ProgramDefinition<Table> {
  return definition;
}

/** An option with the names under which it is found. */
export interface OptionPlace {
  readonly key: string;
  readonly spec: OptionSpec;
  readonly flag: string | null;
  readonly env: string | null;
}

/** Every option of a program, its own before the common ones. */
export function optionPlaces<Table extends OptionTable>(definition: ProgramDefinition<Table>): OptionPlace[] {
  const table: OptionTable = { ...definition.options, ...commonOptions };
  return Object.entries(table).map(([key, spec]) => ({
    key,
    spec,
    flag: spec.flag === false ? null : (spec.flag ?? `--${words(key).join('-').toLowerCase()}`),
    env: spec.env === false ? null : (spec.env ?? environmentName(definition.section, key)),
  }));
}

export function environmentName(section: string, key: string): string {
  return `FARPOINT_${section.toUpperCase()}_${words(key).join('_').toUpperCase()}`;
}

function words(key: string): string[] {
  return key.split(/(?=[A-Z])/);
}
