/** How the robot program ends, and what it leaves for its next start: only an end that was asked for is one. */
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, it, onTestFinished } from 'vitest';

const program = fileURLToPath(new URL('./main.ts', import.meta.url));
const ID = 'ending';
/** Faults that the program has on a signal. */
const FAULTS = `data:text/javascript,${encodeURIComponent(
  "process.on('SIGUSR2',()=>{throw new Error('a fault')});process.on('SIGWINCH',()=>{Promise.reject(new Error('a fault'))})",
)}`;

/** Ends by a signal. @returns the exit code, and why it says that it is latched at its next start */
async function endsBy(signal: NodeJS.Signals): Promise<{ code: number | null; leaves: unknown }> {
  const folder = testFolder();
  const robot = spawn(
    process.execPath,
    [
      ...['--import', FAULTS, program, '--id', ID, '--sim-size', '16', '--admin-port', '0'],
      ...['--signaling', 'ws://127.0.0.1:9', '--state-dir', folder, '--log-format', 'json'],
    ],
    { stdio: ['ignore', 'pipe', 'inherit'] },
  );
  onTestFinished(() => void robot.kill('SIGKILL'));
  const ended = new Promise<number | null>((resolve) => robot.once('exit', resolve));
  for await (const line of createInterface({ input: robot.stdout }))
    if (line.includes('health and metrics')) break;
  robot.stdout.resume();
  robot.kill(signal);
  const code = await ended;
  return { code, leaves: JSON.parse(readFileSync(join(folder, `${ID}.run.json`), 'utf8')) };
}

it.each([
  ['SIGTERM', 0, false],
  // An exception that nobody catches, and a promise that nobody looks at.
  ['SIGUSR2', 1, true],
  ['SIGWINCH', 1, true],
  ['SIGKILL', null, true],
] as const)(
  'after %s the program ends with %s, and its next start is latched: %s',
  async (signal, code, running) => {
    expect(await endsBy(signal)).toMatchObject({ code, leaves: { running, latchedBy: null } });
  },
  30_000,
);
