/** Stands in for the memory's worker: remembers at once, on the caller's thread, so that a test knows what is remembered. */
import * as files from '../memory/memory-files.ts';
import { MemoryKeeping } from '../memory/memory-keeping.ts';
import type { FromMemoryWorker, ToMemoryWorker } from '../memory/memory-messages.ts';

/** The parts of a `Worker` that the library uses. */
export class MemoryWorkerHere {
  onmessage: ((event: { data: FromMemoryWorker }) => void) | null = null;
  readonly #waiting: ToMemoryWorker[] = [];
  readonly #answers: FromMemoryWorker[] = [];
  readonly #keeping = new MemoryKeeping({
    // A copy, as between threads: who keeps a buffer that it has handed over finds it detached.
    post: (message, transfer) => this.#answers.push(structuredClone(message, { transfer })),
    nowMs: () => performance.now(),
    withFiles: (use) => use(files),
  });
  #busy = false;

  postMessage(message: ToMemoryWorker, transfer: Transferable[] = []): void {
    this.#waiting.push(structuredClone(message, { transfer }));
    if (this.#busy) return;
    // An answer may bring the next message, which a worker would take only when it has done with this one.
    this.#busy = true;
    for (let next = this.#waiting.shift(); next !== undefined; next = this.#waiting.shift()) {
      this.#keeping.onMessage(next);
      for (const answer of this.#answers.splice(0)) this.onmessage?.({ data: answer });
    }
    this.#busy = false;
  }

  terminate(): void {}
}
