import { once } from 'node:events';
import { Worker } from 'node:worker_threads';
import type { FuzzResult } from './fuzz.ts';

export interface FuzzOrder {
  names: readonly string[];
  /** For all parsers together. */
  inputs: number;
  seed: number;
  /** A counter, a length, and the input that is being read. */
  current: SharedArrayBuffer;
}

export interface Hang {
  name: string;
  input: Uint8Array;
}

export interface FuzzReport {
  results: FuzzResult[];
  /** The parser that did not return, if any; what would have come after it was not tried. */
  hang: Hang | null;
  /** In use after the first parser and after the last, bytes. */
  memory: { first: number; last: number };
}

const LONGEST_INPUT = 65_536;
/** No input may take longer, ms. */
export const HANG_MS = 10_000;
const LOOK_MS = 1000;

type FromWorker = { type: 'begun'; name: string } | { type: 'result'; result: FuzzResult; bytes: number };

/** Runs the worker and watches that it goes on. */
export async function supervise(
  order: Omit<FuzzOrder, 'current'>,
  onResult: (result: FuzzResult, bytes: number) => void,
): Promise<FuzzReport> {
  const current = new SharedArrayBuffer(8 + LONGEST_INPUT);
  const workerData: FuzzOrder = { ...order, current };
  const worker = new Worker(new URL('worker.ts', import.meta.url), { workerData });
  const report: FuzzReport = { results: [], hang: null, memory: { first: 0, last: 0 } };
  let name = '';
  worker.on('message', (message: FromWorker) => {
    if (message.type === 'begun') {
      name = message.name;
      return;
    }
    report.results.push(message.result);
    report.memory.first ||= message.bytes;
    report.memory.last = message.bytes;
    onResult(message.result, message.bytes);
  });
  const [count, length] = [new Uint32Array(current, 0, 1), new Uint32Array(current, 4, 1)];
  let [seen, sinceMs] = [0, performance.now()];
  const timer = setInterval(() => {
    const now = Atomics.load(count, 0);
    if (now !== seen) [seen, sinceMs] = [now, performance.now()];
    else if (name !== '' && performance.now() - sinceMs > HANG_MS) {
      report.hang = { name, input: new Uint8Array(current, 8, length[0]).slice() };
      void worker.terminate();
    }
  }, LOOK_MS);
  try {
    await once(worker, 'exit');
  } finally {
    clearInterval(timer);
  }
  return report;
}
