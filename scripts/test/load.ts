/** Busy programs beside the tests, and the cores on which both run. */
import { type ChildProcess, spawn } from 'node:child_process';
import { join } from 'node:path';
import { root, run } from '../lib/run.ts';

export interface Load {
  pids: readonly (number | undefined)[];
  end(): void;
}

/** Starts so many busy programs. They end with this one at the latest, also when it is killed. */
export function startLoad(count: number): Load {
  const programs: ChildProcess[] = [];
  for (let i = 0; i < count; i++)
    programs.push(
      spawn(process.execPath, [join(root, 'scripts/test/busy-program.ts')], {
        stdio: ['pipe', 'ignore', 'inherit'],
      }),
    );
  return {
    pids: programs.map(({ pid }) => pid),
    end: () => {
      for (const { stdin } of programs) stdin?.end();
    },
  };
}

/**
 * Keeps this program, and all that it starts from now on, to the first cores.
 *
 * @throws {Error} with what the system says, where it does not allow that
 */
export async function pinTo(cpus: number): Promise<void> {
  const { code, output } = await run('taskset', ['-acp', `0-${cpus - 1}`, String(process.pid)]);
  if (code !== 0) throw new Error(`--cpus: ${output.trim() || 'taskset (util-linux) is needed'}`);
}
