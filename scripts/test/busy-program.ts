/** Keeps one core busy until whoever started it is gone: its standard input ends with that program, however it ends. */
import { isMainThread, Worker } from 'node:worker_threads';

if (isMainThread) {
  // The loop has a thread of its own, so that this one sees the end at once.
  new Worker(new URL(import.meta.url));
  process.stdin.resume();
  process.stdin.once('end', () => process.exit(0));
} else {
  for (;;);
}
