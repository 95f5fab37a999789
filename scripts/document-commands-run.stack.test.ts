/** Every command in README and documents that can run where tests run does: as written, and as the table says. */
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, test } from 'vitest';
import type { Treatment } from './lib/document-command-table.ts';
import { shellWords } from './lib/document-commands.ts';
import { known, type Program, programOf } from './lib/document-programs.ts';
import { root } from './lib/run.ts';

const folder = useFolder();

type Running = Extract<Treatment, { up: unknown }> | Extract<Treatment, { refused: unknown }>;

test.each(known.filter(({ treatment }) => 'up' in treatment || 'refused' in treatment))(
  '$text',
  { timeout: 60_000 },
  async ({ text, treatment }) => {
    const { said, code } = await runs(programOf(shellWords(text)), treatment as Running);
    const wanted = 'up' in treatment ? treatment.up : (treatment as { refused: RegExp }).refused;
    expect(said.join('\n')).toMatch(typeof wanted === 'string' ? wanted : new RegExp(wanted, 'm'));
    if ('up' in treatment) expect(code, said.join('\n')).toBe(0);
    else expect(code).not.toBe(0);
  },
);

/** The document's own words come first: if an option is given twice, the last one counts. */
async function runs({ file, args }: Program, treatment: Running): Promise<{ said: string[]; code: unknown }> {
  const fill = 'fill' in treatment ? treatment.fill : undefined;
  // Dots at the end stand for additions by the reader; dots after an option stand for its value.
  const own = args.at(-1) === '…' && !/^--token$/.test(args.at(-2) ?? '') ? args.slice(0, -1) : args;
  const words = own.map((word) => fill?.[word] ?? word);
  const child = spawn(process.execPath, [join(root, file), ...words, ...(treatment.also ?? [])], {
    cwd: folder,
    // A folder of its own, away from the robot state of the person who runs the tests.
    env: { ...process.env, XDG_STATE_HOME: folder },
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  const exited = new Promise((resolve) => child.once('exit', resolve));
  const said: string[] = [];
  const errors = createInterface({ input: child.stderr }).on('line', (line) => said.push(line));
  for await (const line of createInterface({ input: child.stdout })) {
    const { msg } = JSON.parse(line) as { msg: string };
    said.push(msg);
    if ('up' in treatment && msg.match(treatment.up) !== null) child.kill('SIGTERM');
  }
  const code = await exited;
  errors.close();
  return { said, code };
}
