/** The thread that feeds cameras, which hangs whenever a key frame is asked for. */
import { parentPort } from 'node:worker_threads';
import '../sense/video/feed/feed-worker.ts';

parentPort?.on('message', ({ type }: { type: string }) => {
  while (type === 'key-frame');
});
