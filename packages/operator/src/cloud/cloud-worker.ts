/// <reference lib="webworker" />
/** The cloud worker: decodes point packets off the main thread. */
import { loadCodec } from '@farpoint/wasm-codec';
import { CloudDecoding, type EncodedPayload } from './cloud-decoding.ts';
import type { CloudTransformOptions, ToCloudWorker } from './worker-messages.ts';

declare const self: DedicatedWorkerGlobalScope & {
  onrtctransform: ((event: RTCTransformEvent) => void) | null;
};

/** How often the page is told what was received, ms: it shows this a few times a second. */
const REPORT_EVERY_MS = 100;

const decoding = new CloudDecoding(loadCodec(), {
  post: (message, transfer) => self.postMessage(message, transfer),
  nowMs: () => performance.now(),
  timeOriginMs: performance.timeOrigin,
  setTimer: (act, afterMs) => self.setTimeout(act, afterMs),
  clearTimer: (timer) => self.clearTimeout(timer),
});

self.onmessage = ({ data }: MessageEvent<ToCloudWorker>) => decoding.onMessage(data);

self.onrtctransform = ({ transformer }: RTCTransformEvent) => {
  const { generation } = transformer.options as CloudTransformOptions;
  void decoding.consume(transformer.readable as ReadableStream<EncodedPayload>, generation);
};

setInterval(() => decoding.report(), REPORT_EVERY_MS);
