/** `pnpm conformance` as users run it. */
import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { afterEach, expect, it } from 'vitest';
import { ReleasedSignaling } from './testing/index.ts';

const PROGRAM = fileURLToPath(new URL('main.ts', import.meta.url));

let signaling: ReleasedSignaling | null = null;
afterEach(() => signaling?.stop());

function run(...args: string[]): Promise<{ code: number; out: string; err: string }> {
  return new Promise((resolve) => {
    execFile(process.execPath, [PROGRAM, ...args], (error, out, err) =>
      resolve({ code: error === null ? 0 : Number(error.code), out, err }),
    );
  });
}

it('at level reference, passes the released signaling and names its defects; at level strict, fails it', async () => {
  signaling = await ReleasedSignaling.start();
  const urls = ['--robot', signaling.robotUrl, '--client', signaling.clientUrl];
  const lenient = await run('signaling', ...urls, '--level', 'reference', '--json');
  expect(lenient.code).toBe(0);
  expect(lenient.err).toContain('known defect robot-0-dropped');
  expect(lenient.err).toContain('0 failed, 5 known defects at level reference');
  const { outcome } = JSON.parse(lenient.out).at(-1);
  expect(outcome).toBe('not-tried');
  expect(signaling.death).toBeNull();
  expect((await run('signaling', ...urls)).code).toBe(1);
  expect(signaling.death).not.toBeNull();
}, 60_000);

it.each([
  [['signaling', '--level', 'lenient'], '--level lenient: must be one of reference, strict'],
  [['signaling', '--levle', 'strict'], "Unknown option '--levle'"],
])('%j: says which argument is invalid', async (args, message) => {
  const { code, err } = await run(...args);
  expect(code).toBe(2);
  expect(err).toContain(message);
  expect(err).not.toContain('    at ');
});
