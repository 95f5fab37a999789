/** A program that uses DDS only in a worker that ends; the program should then exit with 0. */
import { Worker } from 'node:worker_threads';

const source = new URL('./closing-worker.ts', import.meta.url);
for (let i = 0; i < 2; i++) {
  const code = await new Promise((resolve) => new Worker(source).once('exit', resolve));
  if (code !== 0) process.exit(1);
}
