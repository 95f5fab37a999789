/** `farpoint-robot init`: writes a configuration file with every option, explained. It asks no questions. */
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { DEFAULT_CONFIG_PATH } from '@farpoint/service';
import { SOURCE_KINDS } from '../options/source.ts';
import { robotTemplate, type SourceKind } from './robot-template.ts';

/** The parts of the process that a command may use. */
export interface CommandRim {
  stdout: { write(text: string): unknown };
  stderr: { write(text: string): unknown };
}

const HELP = `farpoint-robot init [--source KIND] [--output FILE] [--audit FILE] [--force]

Writes a configuration file for a robot, with a comment for each option.

  --source KIND  source of the clouds: ${SOURCE_KINDS.join(', ')} (default: sim)
  --output FILE  file to write (default: ${DEFAULT_CONFIG_PATH}); - for standard output
  --audit FILE   record who did what in this file (audit.log)
  --force        replace an existing file
`;

/** @returns the exit code: 0, 1 if the file could not be written, 2 for a mistake in the arguments */
export function init(argv: readonly string[], { stdout, stderr }: CommandRim): number {
  const refuse = (message: string, code: number): number => {
    stderr.write(`farpoint-robot init: ${message}\n`);
    return code;
  };
  let values: ReturnType<typeof parse>;
  try {
    values = parse(argv);
  } catch (error) {
    return refuse((error as Error).message, 2);
  }
  if (values.help) {
    stdout.write(HELP);
    return 0;
  }
  const source = SOURCE_KINDS.find((kind) => kind === values.source);
  if (source === undefined)
    return refuse(
      `--source must be one of ${SOURCE_KINDS.join(', ')}, not ${JSON.stringify(values.source)}`,
      2,
    );
  const text = robotTemplate(source, values.audit);
  if (values.output === '-') {
    stdout.write(text);
    return 0;
  }
  try {
    // The file may hold a token: limit who can read it.
    writeFileSync(values.output, text, { flag: values.force ? 'w' : 'wx', mode: 0o640 });
  } catch (error) {
    const { code, message } = error as NodeJS.ErrnoException;
    if (code === 'EEXIST') return refuse(`${values.output} already exists; --force replaces it`, 1);
    return refuse(`${values.output} cannot be written: ${message}`, 1);
  }
  stdout.write(`Wrote ${values.output}. Next: ${next(source, values.output)}\n`);
  return 0;
}

function next(source: SourceKind, output: string): string {
  const config = output === DEFAULT_CONFIG_PATH ? '' : ` --config ${output}`;
  const needs: Partial<Record<SourceKind, string>> = {
    recording: 'set source.path, ',
    pcd: 'set source.path, ',
    rgbd: 'set source.path, ',
  };
  return `${needs[source] ?? ''}set signaling.url, then \`farpoint-robot doctor${config}\`.`;
}

function parse(argv: readonly string[]) {
  const { values } = parseArgs({
    args: [...argv],
    options: {
      source: { type: 'string', default: 'sim' },
      output: { type: 'string', default: DEFAULT_CONFIG_PATH },
      audit: { type: 'string' },
      force: { type: 'boolean', default: false },
      help: { type: 'boolean', short: 'h', default: false },
    },
  });
  return values;
}
