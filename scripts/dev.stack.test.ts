/** `pnpm dev` as people run it. Its usual ports may be taken; it then uses free ones. */
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { repositoryRoot } from '@farpoint/local-stack';
import { afterEach, expect, test } from 'vitest';

let dev: ChildProcess | null = null;
afterEach(() => {
  dev?.kill('SIGTERM');
});

test.skipIf(process.platform !== 'linux')(
  'reports and restarts a robot that is killed; signaling and page live on',
  async () => {
    dev = spawn(process.execPath, ['scripts/dev.ts'], {
      cwd: repositoryRoot,
      stdio: ['ignore', 'pipe', 'pipe'],
    });
    const exited = new Promise((resolve) => dev?.once('exit', resolve));
    const said = createInterface({ input: dev.stdout! })[Symbol.asyncIterator]();
    const complaints = createInterface({ input: dev.stderr! })[Symbol.asyncIterator]();
    const url = await seen(said, /Open\s+(http:\S+)/);
    const before = children(dev.pid!);
    const robot = before.find(({ command }) => command.includes('sim-1'));
    process.kill(robot!.pid, 'SIGKILL');
    await seen(complaints, /^(sim-1 has ended \(SIGKILL\)); restarting it in/);
    await seen(said, /^(sim-1 is running again)/);
    expect((await fetch(url)).status).toBe(200);
    const after = new Set(children(dev.pid!).map(({ pid }) => pid));
    expect(before.filter(({ pid }) => !after.has(pid))).toEqual([robot]);
    dev.kill('SIGTERM');
    expect(await exited).toBe(0);
    expect([...after].filter(lives)).toEqual([]);
  },
  60_000,
);

test('reports a mistake on its command line in one sentence', () => {
  const { status, stderr } = spawnSync(process.execPath, ['scripts/dev.ts', '--robot', '2'], {
    ...{ cwd: repositoryRoot, encoding: 'utf8' },
  });
  expect(status).toBe(2);
  expect(stderr).toBe(
    'pnpm dev: --robot is not an option (did you mean --robots?); `pnpm dev --help` lists them\n',
  );
});

/** What the pattern's first group matched in the next line that fits. */
async function seen(lines: AsyncIterator<string>, pattern: RegExp): Promise<string> {
  for (;;) {
    const line = await lines.next();
    if (line.done === true) throw new Error(`never said: ${String(pattern)}`);
    const found = pattern.exec(line.value);
    if (found !== null) return found[1] ?? '';
  }
}

function children(pid: number): { pid: number; command: string }[] {
  return readFileSync(`/proc/${pid}/task/${pid}/children`, 'utf8')
    .split(' ')
    .filter((child) => child.trim() !== '')
    .map((child) => ({
      pid: Number(child),
      command: readFileSync(`/proc/${child}/cmdline`, 'utf8').replaceAll('\0', ' '),
    }));
}

function lives(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch {
    return false;
  }
}
