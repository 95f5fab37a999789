/** `… audit verify FILE…`: the command with which both programs verify their logs. */
import { parseArgs } from 'node:util';
import { verifyFiles } from './verify-files.ts';

/** The parts of the process that the command may use. */
export interface AuditCommandRim {
  stdout: { write(text: string): unknown };
  stderr: { write(text: string): unknown };
}

const help = (program: string) => `${program} audit verify FILE… [--partial] [--contains HASH]

Verifies an audit log: prints one line, and says which is the first entry that was changed, removed, moved or added.
Exit status: 0 if there is none, 1 if there is one, 2 for a mistake in the arguments.

  FILE             the log's files, the rotated ones too, in any order
  --partial        the older files are elsewhere: the log need not begin with its first entry
  --contains HASH  an entry must have this hash, which an earlier run printed: nothing up to it was cut off
`;

/** @returns the exit status */
export function auditCommand(
  program: string,
  argv: readonly string[],
  { stdout, stderr }: AuditCommandRim,
): number {
  const mistake = (message: string): number => {
    stderr.write(`${program} audit: ${message}\n${help(program)}`);
    return 2;
  };
  const [name = '--help', ...rest] = argv;
  if (['--help', '-h'].includes(name) || rest.some((each) => ['--help', '-h'].includes(each))) {
    stdout.write(help(program));
    return 0;
  }
  if (name !== 'verify') return mistake(`no command ${JSON.stringify(name)}`);
  let given: ReturnType<typeof parse>;
  try {
    given = parse(rest);
  } catch (error) {
    return mistake((error as Error).message);
  }
  const { values, positionals: files } = given;
  const { partial, contains: expected } = values;
  if (files.length === 0) return mistake('verify needs the log’s files');
  if (new Set(files).size < files.length) return mistake('a file is named twice');
  if (expected !== undefined && !/^[0-9a-f]{64}$/.test(expected))
    return mistake('--contains needs a hash of 64 hexadecimal digits');
  let result: ReturnType<typeof verifyFiles>;
  try {
    result = verifyFiles(files, { partial, expected });
  } catch (error) {
    stderr.write(`${program} audit: ${(error as Error).message}\n`);
    return 1;
  }
  if ('kind' in result) {
    const { kind, place, detail } = result;
    stdout.write(`not as written (${kind}): ${place.file}, line ${place.line}: ${detail}\n`);
    return 1;
  }
  const { first, last, entries, torn, containsExpected } = result;
  if (containsExpected === false) {
    stdout.write(
      `not as written (missing): no entry has the hash ${expected}; the last is entry ${last.sequence}\n`,
    );
    return 1;
  }
  const torns = torn === 0 ? '' : `, ${torn} torn by a crash`;
  stdout.write(
    `as written: entries ${first.sequence}–${last.sequence} (${entries}${torns}), ${first.time} to ${last.time}, last hash ${last.hash}\n`,
  );
  return 0;
}

function parse(argv: readonly string[]) {
  return parseArgs({
    args: [...argv],
    allowPositionals: true,
    options: { partial: { type: 'boolean', default: false }, contains: { type: 'string' } },
  });
}
