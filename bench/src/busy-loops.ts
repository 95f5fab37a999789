/** Programs that do nothing but take the processor's time from what is measured beside them. */
import { type ChildProcess, spawn } from 'node:child_process';

/**
 * Each takes a core, if there is one.
 *
 * @param count how many
 * @returns the processes, which the caller kills
 */
export function startBusyLoops(count: number): ChildProcess[] {
  const loops: ChildProcess[] = [];
  for (let i = 0; i < count; i++)
    loops.push(spawn(process.execPath, ['-e', 'for (;;);'], { stdio: 'ignore' }));
  return loops;
}
