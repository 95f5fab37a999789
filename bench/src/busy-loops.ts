/** Programs that take processor time from what a benchmark measures beside them. */
import { type ChildProcess, spawn } from 'node:child_process';

export class BusyLoops {
  readonly #loops: ChildProcess[] = [];

  /** Each loop takes a core, if there is one. */
  constructor(count: number) {
    for (let i = 0; i < count; i++)
      this.#loops.push(spawn(process.execPath, ['-e', 'for (;;);'], { stdio: 'ignore' }));
  }

  stop(): void {
    for (const loop of this.#loops) loop.kill('SIGKILL');
  }
}
