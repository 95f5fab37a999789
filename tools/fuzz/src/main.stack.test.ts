/** `pnpm fuzz` as users run it. */
import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const PROGRAM = fileURLToPath(new URL('main.ts', import.meta.url));

function run(...args: string[]): Promise<{ code: number; out: string; err: string }> {
  return new Promise((resolve) => {
    execFile(process.execPath, [PROGRAM, ...args], (error, out, err) =>
      resolve({ code: error === null ? 0 : Number(error.code), out, err }),
    );
  });
}

it('counts what it has read, by parser', async () => {
  const { code, out, err } = await run('--only', 'dtls-record,stun', '--inputs', '5000', '--json');
  expect(err).toContain('5000 inputs for 2 parsers');
  expect(code).toBe(0);
  expect(JSON.parse(out)).toMatchObject({
    inputs: 5000,
    hang: null,
    results: [{ name: 'dtls-record' }, { name: 'stun' }],
  });
});

it.each([
  [['--only', 'nothing'], '--only: there is no parser nothing'],
  [['--inputs', 'many'], '--inputs many: must be a positive whole number'],
  [['--imputs', '1'], "Unknown option '--imputs'"],
])('%j: says which argument is invalid', async (args, message) => {
  const { code, err } = await run(...args);
  expect(code).toBe(2);
  expect(err).toContain(message);
  expect(err).not.toContain('    at ');
});
