/** Busy programs never outlive what started them. */
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { expect, test, vi } from 'vitest';
import { root } from '../lib/run.ts';

const isAlive = (pid: number): boolean => {
  try {
    process.kill(pid, 0);
    return true;
  } catch {
    return false;
  }
};

test.each(['SIGTERM', 'SIGKILL'] as const)(
  'busy programs end when what started them ends by %s',
  async (signal) => {
    const module = JSON.stringify(join(root, 'scripts/test/load.ts'));
    const starts = `import { startLoad } from ${module}; console.log(startLoad(2).pids.join()); setInterval(() => {}, 1e6);`;
    const owner = spawn(process.execPath, ['--input-type=module', '-e', starts], {
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    const [text] = (await once(owner.stdout, 'data')) as [Buffer];
    const pids = text.toString().trim().split(',').map(Number);
    expect(pids.map(isAlive)).toEqual([true, true]);
    owner.kill(signal);
    await vi.waitFor(() => expect(pids.map(isAlive)).toEqual([false, false]), { timeout: 20_000 });
  },
  30_000,
);
