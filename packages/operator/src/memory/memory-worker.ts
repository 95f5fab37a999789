/// <reference lib="webworker" />
/** The memory's worker: keeps the remembered world off the main thread, and beside the decoding. */
import { MemoryKeeping } from './memory-keeping.ts';
import type { ToMemoryWorker } from './memory-messages.ts';

declare const self: DedicatedWorkerGlobalScope;

const keeping = new MemoryKeeping({
  post: (message, transfer) => self.postMessage(message, transfer),
  nowMs: () => performance.now(),
  withFiles: (use, failed) => void import('./memory-files.ts').then(use, failed),
});

self.onmessage = ({ data }: MessageEvent<ToMemoryWorker>) => keeping.onMessage(data);
