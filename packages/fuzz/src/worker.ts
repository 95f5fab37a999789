/** Fuzzes one parser after another in a thread, so that somebody notices if one of them never returns. */
import { parentPort, workerData } from 'node:worker_threads';
import { allTargets } from './all-targets.ts';
import { fuzz } from './fuzz.ts';
import type { FuzzOrder } from './supervise.ts';
import { corpusOf } from './vectors.ts';

if (parentPort !== null) {
  const { names, inputs, seed, current } = workerData as FuzzOrder;
  const [count, length] = [new Uint32Array(current, 0, 1), new Uint32Array(current, 4, 1)];
  const bytes = new Uint8Array(current, 8);
  const onInput = (input: Uint8Array) => {
    length[0] = Math.min(input.length, bytes.length);
    bytes.set(input.subarray(0, bytes.length));
    Atomics.add(count, 0, 1);
  };
  const chosen = allTargets.filter(({ name }) => names.includes(name));
  const shares = chosen.reduce((sum, { share = 1 }) => sum + share, 0);
  for (const target of chosen) {
    parentPort.postMessage({ type: 'begun', name: target.name });
    const own = Math.ceil((inputs * (target.share ?? 1)) / shares);
    const result = await fuzz(target, { inputs: own, seed, corpus: corpusOf(target.name), onInput });
    parentPort.postMessage({ type: 'result', result, heapBytes: process.memoryUsage().rss });
  }
}
