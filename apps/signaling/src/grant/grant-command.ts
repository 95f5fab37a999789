/** `farpoint-signaling grant …`: makes keys, issues, shows and revokes grants. */
import { CommandError, type CommandRim } from './command-rim.ts';
import { ISSUE_HELP, issue } from './issue.ts';
import { KEYGEN_HELP, keygen } from './keygen.ts';
import { REVOKE_HELP, revoke } from './revoke.ts';
import { SHOW_HELP, show } from './show.ts';

const COMMANDS: Readonly<
  Record<string, { help: string; run: (argv: string[], rim: CommandRim) => Promise<number> }>
> = {
  keygen: { help: KEYGEN_HELP, run: keygen },
  issue: { help: ISSUE_HELP, run: issue },
  show: { help: SHOW_HELP, run: show },
  revoke: { help: REVOKE_HELP, run: revoke },
};

const HELP = `farpoint-signaling grant keygen|issue|show|revoke …

Grants say who may use which robots, in what role and until when. Robots with --grant-keys admit nobody else.

${[KEYGEN_HELP, ISSUE_HELP, SHOW_HELP, REVOKE_HELP].join('\n')}`;

/** @returns the exit status: 0, 1 if it did not succeed, 2 for a mistake in the arguments */
export async function grantCommand(argv: readonly string[], rim: CommandRim): Promise<number> {
  const [name = '--help', ...rest] = argv;
  const command = Object.hasOwn(COMMANDS, name) ? COMMANDS[name] : undefined;
  if (command === undefined) {
    const help = ['--help', '-h'].includes(name);
    (help ? rim.stdout : rim.stderr).write(
      help ? HELP : `farpoint-signaling grant: no command ${name}\n${HELP}`,
    );
    return help ? 0 : 2;
  }
  if (rest.some((argument) => ['--help', '-h'].includes(argument))) {
    rim.stdout.write(command.help);
    return 0;
  }
  try {
    return await command.run(rest, rim);
  } catch (error) {
    const mistake = error instanceof CommandError || isArgumentError(error);
    if (!mistake) throw error;
    rim.stderr.write(`farpoint-signaling grant ${name}: ${(error as Error).message}\n`);
    return error instanceof CommandError ? error.status : 2;
  }
}

function isArgumentError(error: unknown): boolean {
  return (
    error instanceof TypeError && String((error as NodeJS.ErrnoException).code).startsWith('ERR_PARSE_ARGS')
  );
}
