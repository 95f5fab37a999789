/** The thread that hears the guard's topics, which also ends or hangs on command: by the broadcast channel `guard-worker`. */
import { BroadcastChannel, parentPort } from 'node:worker_threads';

const wire = new BroadcastChannel('guard-worker');
wire.onmessage = (event) => {
  const { data } = event as unknown as { data: unknown };
  if (data === 'throw') throw new Error('the thread was killed');
  while (data === 'hang');
};
parentPort?.on('message', ({ type }: { type: string }) => type === 'close' && wire.close());

await import('../motion/obstacles/guard-topics-worker.ts');
