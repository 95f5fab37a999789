import { Command, CommanderError, Option } from 'commander';
import { OptionsError } from './option-errors.ts';
import type { OptionPlace, OptionTable, ProgramDefinition } from './option-table.ts';

export type ParsedFlags =
  | { action: 'help' }
  | { action: 'version' }
  | { action: 'schema' }
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
    if (error.code === 'commander.helpDisplayed') return { action: 'help' };
    if (error.code === 'commander.version') return { action: 'version' };
    // "error: unknown option '--prot'\n(Did you mean --port?)"
    const detail = error.message.replace(/^error: /, '').replace(/\s*\n\s*/g, ' ');
    throw new OptionsError('command line:', detail);
  }
  const given = command.opts<Record<string, unknown>>();
  if (given.configSchema === true) return { action: 'schema' };
  const values = new Map<string, unknown>();
  for (const [attribute, key] of keys) {
    if (command.getOptionValueSource(attribute) === 'cli') values.set(key, given[attribute]);
  }
  return { action: 'run', values };
}

/** The output of `--help`: every option with its default and its environment variable. */
export function helpText(definition: ProgramDefinition<OptionTable>, places: readonly OptionPlace[]): string {
  const { command } = buildCommand(definition, places);
  const commands = Object.entries(definition.commands ?? {});
  if (commands.length === 0) return command.helpInformation();
  const lines = commands.map(([name, what]) => `  ${`${definition.name} ${name}`.padEnd(26)} ${what}\n`);
  return `${command.helpInformation()}\nCommands (each has its own --help):\n${lines.join('')}`;
}

function buildCommand(
  definition: ProgramDefinition<OptionTable>,
  places: readonly OptionPlace[],
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
    .option('--config-schema', 'print the JSON Schema of the configuration file, for editors')
    .helpOption('-h, --help', 'print this help')
    .exitOverride()
    .configureOutput(silent)
    .configureHelp({ helpWidth: 110 });
  const keys = new Map<string, string>();
  for (const place of places) {
    if (place.flag === null) continue;
    const { spec, flag, key } = place;
    const description = `${spec.help} ${origins(place)}`;
    const option = new Option(spec.argument === undefined ? flag : `${flag} <${spec.argument}>`, description);
    keys.set(option.attributeName(), key);
    if (spec.argument !== undefined) {
      command.addOption(option);
      continue;
    }
    // For a boolean, both `--x` and `--no-x` work; help shows the one that changes the default.
    const negated = new Option(flag.replace(/^--/, '--no-'), description);
    command.addOption(option.hideHelp(spec.default === true));
    command.addOption(negated.hideHelp(spec.default !== true));
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
