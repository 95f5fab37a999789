/** `pnpm attack` as users run it. */
import { execFile, spawn } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { allAttacks } from './all-attacks.ts';
import { LAYERS } from './attack.ts';

const PROGRAM = fileURLToPath(new URL('main.ts', import.meta.url));

function run(...args: string[]): Promise<{ code: number; out: string; err: string }> {
  return new Promise((resolve) => {
    execFile(process.execPath, [PROGRAM, ...args], (error, out, err) =>
      resolve({ code: error === null ? 0 : Number(error.code), out, err }),
    );
  });
}

it('has attacks on every layer, each under a name of its own', async () => {
  const { code, out } = await run('--list');
  expect(code).toBe(0);
  expect(out.trim().split('\n')).toHaveLength(allAttacks.length);
  expect(new Set(allAttacks.map(({ layer }) => layer))).toEqual(new Set(LAYERS));
  expect(new Set(allAttacks.map(({ layer, name }) => `${layer} ${name}`)).size).toBe(allAttacks.length);
  expect(allAttacks.length).toBeGreaterThanOrEqual(60);
});

it('runs the chosen attacks against the real programs, and prints what came of each', async () => {
  const { code, out, err } = await run('--only', 'plaintext', '--json');
  expect(err).toContain('4 attacks: 4 held, 0 harmed, 0 not tried');
  expect(JSON.parse(out)).toMatchObject([
    { layer: 'dtls', name: 'plaintext close alert from a stranger', outcome: 'held', detail: null },
    { outcome: 'held' },
    { outcome: 'held' },
    { outcome: 'held' },
  ]);
  expect(code).toBe(0);
}, 60_000);

it('lets a watcher send one packet a thousand times beside the driver, and prints what each took', async () => {
  const { code, out, err } = await run('--only', 'SACK: a gap', '--json');
  expect(err).toContain('1 attacks: 1 held, 0 harmed, 0 not tried');
  expect(err).toMatch(/1000 packets, \d+ µs each, pause \d+ ms, -?\d+ MB/);
  const [{ tally }] = JSON.parse(out) as [{ tally: { packets: number } }];
  // With what it has set up before.
  expect(tally.packets).toBeGreaterThan(1000);
  expect(err).toContain(`1 patterns of an admitted watcher, ${tally.packets} packets`);
  expect(code).toBe(0);
}, 90_000);

/** Of its own programs, by pid. */
function childrenOf(pid: number | undefined): string[] {
  return readdirSync('/proc').filter((name) => {
    if (!/^\d+$/.test(name)) return false;
    try {
      return readFileSync(`/proc/${name}/status`, 'utf8').includes(`\nPPid:\t${pid}\n`);
    } catch {
      // It has ended in between.
      return false;
    }
  });
}

it.skipIf(process.platform !== 'linux').each([
  ['SIGTERM', 143],
  ['SIGINT', 130],
] as const)('ended by %s, leaves none of its programs running', { timeout: 60_000 }, async (signal, code) => {
  const attack = spawn(process.execPath, [PROGRAM, '--only', 'plaintext'], {
    stdio: ['ignore', 'ignore', 'pipe'],
  });
  try {
    // The first result: by then everything runs.
    await once(attack.stderr, 'data');
    const children = childrenOf(attack.pid);
    expect(children.length).toBeGreaterThanOrEqual(4);
    attack.kill(signal);
    expect(await once(attack, 'exit')).toEqual([code, null]);
    await expect
      .poll(() => children.filter((pid) => existsSync(`/proc/${pid}`)), { timeout: 5000 })
      .toEqual([]);
  } finally {
    attack.kill('SIGKILL');
  }
});

it.each([
  [['--only', 'nothing of the kind'], '--only nothing of the kind: no such attack'],
  [['--flood', 'long'], '--flood long: must be a positive number'],
  [['--flod', '1'], "Unknown option '--flod'"],
])('%j: says which argument is invalid', async (args, message) => {
  const { code, err } = await run(...args);
  expect(code).toBe(2);
  expect(err).toContain(message);
  expect(err).not.toContain('    at ');
});
