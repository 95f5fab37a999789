import { Command, CommanderError, Option } from 'commander';
import { OptionsError } from './option-errors.ts';
import { commonOptions, type OptionPlace, type OptionTable, type ProgramDefinition } from './option-table.ts';

export type ParsedFlags =
  /** `all`: of every option, by group. */
  | { action: 'help'; of: 'basics' | 'all' }
  | { action: 'version' }
  /** Key → text (or boolean, for a flag without an argument), only for flags that were given. */
  | { action: 'run'; values: Map<string, unknown> };

/**
 * Parses the command line.
 *
 * @throws {OptionsError} for an unknown flag, a flag without its argument, or an argument without a flag
 */
export function parseFlags(
  definition: ProgramDefinition<OptionTable>,
  places: readonly OptionPlace[],
  argv: readonly string[],
): ParsedFlags {
  const { command, keys } = buildCommand(definition, places);
  try {
    command.parse([...argv], { from: 'user' });
  } catch (error) {
    if (!(error instanceof CommanderError)) throw error;
    if (error.code === 'commander.helpDisplayed') return { action: 'help', of: helpWanted(argv) };
    if (error.code === 'commander.version') return { action: 'version' };
    // "error: unknown option '--prot'\n(Did you mean --port?)"
    const detail = error.message.replace(/^error: /, '').replace(/\s*\n\s*/g, ' ');
    throw new OptionsError('command line:', detail);
  }
  const given = command.opts<Record<string, unknown>>();
  const values = new Map<string, unknown>();
  for (const [attribute, key] of keys) {
    if (command.getOptionValueSource(attribute) === 'cli') values.set(key, given[attribute]);
  }
  return { action: 'run', values };
}

function helpWanted(argv: readonly string[]): 'basics' | 'all' {
  const at = argv.findIndex((argument) => argument === '--help' || argument === '-h');
  return argv[at + 1] === 'all' ? 'all' : 'basics';
}

/**
 * The output of `--help` and of `--help all`: options with their defaults and their environment variables.
 *
 * @param of `basics`: those that the program names as such, and how to see the rest; all of a program that names none
 */
export function helpText(
  definition: ProgramDefinition<OptionTable>,
  places: readonly OptionPlace[],
  of: 'basics' | 'all' = 'basics',
): string {
  const { command } = buildCommand(definition, places, of);
  const parts = [command.helpInformation()];
  const { name, basics, commands = {} } = definition;
  if (of === 'basics' && basics !== undefined) {
    const all = places.filter(({ flag }) => flag !== null).length;
    parts.push(
      `These are ${basics.length} of ${all} options. \`${name} --help all\` lists them all, by group.\n`,
    );
  }
  const lines = Object.entries(commands).map(
    ([command, what]) => `  ${`${name} ${command}`.padEnd(26)} ${what}\n`,
  );
  if (lines.length > 0) parts.push(`Commands (each has its own --help):\n${lines.join('')}`);
  return parts.join('\n');
}

/** The heading under which `--help all` shows an option; `undefined`: under none. */
function headingOf({ groups = {} }: ProgramDefinition<OptionTable>, key: string): string | undefined {
  const [heading] = Object.entries(groups).find(([, table]) => key in table) ?? [];
  if (heading !== undefined) return `${heading}:`;
  return Object.keys(groups).length > 0 && key in commonOptions ? 'Configuration and log:' : undefined;
}

function buildCommand(
  definition: ProgramDefinition<OptionTable>,
  places: readonly OptionPlace[],
  of: 'basics' | 'all' = 'all',
): { command: Command; keys: Map<string, string> } {
  const silent = { writeOut: () => {}, writeErr: () => {} };
  const command = new Command(definition.name)
    .description(
      `${definition.summary}\n\nEach option may be given as a flag, an environment variable, or a key of the ` +
        `section "${definition.section}" of the configuration file; the first of these that gives it wins. ` +
        'A key of the file is shown only if it differs from the flag.',
    )
    .usage('[options]')
    .version(definition.version, '--version', 'print the version')
    .helpOption(
      '-h, --help',
      definition.basics === undefined ? 'print this help' : 'print this help; --help all: of every option',
    )
    .exitOverride()
    .configureOutput(silent)
    .configureHelp({ helpWidth: 110 });
  const keys = new Map<string, string>();
  for (const place of places) {
    if (place.flag === null) continue;
    const { spec, flag, key } = place;
    const isLeftOut = of === 'basics' && definition.basics?.includes(key) === false;
    const heading = of === 'all' ? headingOf(definition, key) : undefined;
    const description = `${spec.help} ${origins(place)}`;
    const option = new Option(spec.argument === undefined ? flag : `${flag} <${spec.argument}>`, description);
    keys.set(option.attributeName(), key);
    if (heading !== undefined) option.helpGroup(heading);
    if (spec.argument !== undefined) {
      command.addOption(option.hideHelp(isLeftOut));
      continue;
    }
    // For a boolean, both `--x` and `--no-x` work; help shows the one that changes the default.
    const negated = new Option(flag.replace(/^--/, '--no-'), description);
    if (heading !== undefined) negated.helpGroup(heading);
    command.addOption(option.hideHelp(isLeftOut || spec.default === true));
    command.addOption(negated.hideHelp(isLeftOut || spec.default !== true));
  }
  return { command, keys };
}

function origins(place: OptionPlace): string {
  const { spec, env, file, key } = place;
  const parts: string[] = [];
  // For a boolean, help shows only the flag that changes the default, so no default is printed.
  if (
    spec.argument !== undefined &&
    spec.default !== null &&
    !spec.secret &&
    !(Array.isArray(spec.default) && spec.default.length === 0)
  ) {
    const shown = Array.isArray(spec.default) ? spec.default.join(',') : String(spec.default);
    parts.push(`default: ${shown}`);
  }
  if (env !== null) parts.push(`env: ${env}`);
  if (file !== null && file !== key) parts.push(`file: ${file}`);
  return parts.length === 0 ? '' : `(${parts.join(', ')})`;
}
