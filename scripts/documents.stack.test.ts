/** The help of each program that README and documents start names the options that they give it; each is started once. */
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, test } from 'vitest';
import { shellWords } from './lib/document-commands.ts';
import { benchOf, known, names, optionsIn, type Program, programOf } from './lib/document-programs.ts';
import { root } from './lib/run.ts';

const folder = useFolder();

const ROBOT = 'apps/robot-node/src/main.ts';
/** Those whose commands have a help of their own. */
const WITH_COMMANDS = [ROBOT, 'apps/signaling/src/main.ts'];

/** The program, and which of its commands. */
function commandOf({ file, args }: Program): string {
  const [first = ''] = args;
  return WITH_COMMANDS.includes(file) && /^[a-z]/.test(first) ? `${file} ${first}` : file;
}

const byCommand = new Map<string, Set<string>>();
for (const { text, treatment } of known) {
  if (!('help' in treatment)) continue;
  const program = programOf(shellWords(text));
  // They are read instead (documents.test.ts): there are many.
  if (benchOf(program) !== null) continue;
  const options = byCommand.get(commandOf(program)) ?? new Set();
  for (const option of optionsIn(program.args)) options.add(option);
  byCommand.set(commandOf(program), options);
}
// The robot's doctor accepts the robot's options, too.
byCommand.set(ROBOT, byCommand.get(ROBOT) ?? new Set());

describe('the options that documents give to a program are in its help', () => {
  const helps = new Map<string, string>();

  test.each([...byCommand].map(([command, options]) => ({ command, options })))(
    '$command',
    { timeout: 60_000 },
    ({ command, options }) => {
      const help = helpOf(command);
      const source = /any option of farpoint-robot/.test(help) ? help + helpOf(ROBOT) : help;
      expect([...options].filter((option) => !names(source, option))).toEqual([]);
    },
  );

  function helpOf(command: string): string {
    const [file = '', ...sub] = command.split(' ');
    const cached = helps.get(command);
    if (cached !== undefined) return cached;
    const ask = command === ROBOT ? ['--help', 'all'] : [...sub, '--help'];
    const { status, stdout, stderr } = spawnSync(process.execPath, [join(root, file), ...ask], {
      ...{ cwd: folder, encoding: 'utf8' },
    });
    expect(status, stderr).toBe(0);
    helps.set(command, stdout);
    return stdout;
  }
});
