/** Fuzzes one parser after another in a thread, so that somebody notices if one of them never returns. */
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { parentPort, workerData } from 'node:worker_threads';
import { allTargets } from './all-targets.ts';
import { fuzz } from './fuzz.ts';
import type { FuzzOrder } from './supervise.ts';
import { corpusOf } from './vectors.ts';

/** What is in use once everything that nobody refers to has been freed, bytes. */
function bytesInUse(): number {
  setFlagsFromString('--expose-gc');
  (runInNewContext('gc') as () => void)();
  const { heapUsed, external } = process.memoryUsage();
  return heapUsed + external;
}

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
    parentPort.postMessage({ type: 'result', result, bytes: bytesInUse() });
  }
}
