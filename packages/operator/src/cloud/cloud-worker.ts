/// <reference lib="webworker" />
/** The cloud's worker: hands the receiver's encoded frames, one RTP payload each, to {@link BatchAssembler}. */
import { loadCodec } from '@farpoint/wasm-codec';
import { BridgeStream } from '../bridge/bridge-stream.ts';
import { BatchAssembler } from './batch-assembler.ts';
import type { CloudTransformOptions, FromCloudWorker, ToCloudWorker } from './worker-messages.ts';

declare const self: DedicatedWorkerGlobalScope & {
  onrtctransform: ((event: RTCTransformEvent) => void) | null;
};

const REPORT_EVERY_MS = 100;

/** https://w3c.github.io/webrtc-encoded-transform/ */
interface AudioFrameMetadata extends RTCEncodedAudioFrameMetadata {
  /** When the packet came, as `performance.now()`; where the browser tells. */
  receiveTime?: number;
}

const post = (message: FromCloudWorker, transfer: Transferable[]) => self.postMessage(message, transfer);
const assembler = new BatchAssembler({
  post,
  nowMs: () => performance.now(),
  timeOriginMs: performance.timeOrigin,
  setTimer: (act, afterMs) => self.setTimeout(act, afterMs),
  clearTimer: (timer) => self.clearTimeout(timer),
});
const loading = loadCodec();
loading.then(
  () => post({ type: 'ready' }, []),
  (error: unknown) =>
    post({ type: 'failed', message: error instanceof Error ? error.message : String(error) }, []),
);
/** `null` where it cannot be loaded: the page has been told. */
const codecReady = loading.catch(() => null);
let bridge: BridgeStream | null = null;

self.onmessage = ({ data: message }: MessageEvent<ToCloudWorker>) => {
  switch (message.type) {
    case 'return':
      assembler.giveBack(message.buffer);
      return;
    case 'stream':
      void consume(message.readable, message.generation);
      return;
    case 'cloudStream':
      void beginStream(message);
      return;
    case 'bridge':
      takeFromBridge(message.url, message.generation);
      return;
    case 'drawEvery':
      assembler.drawEvery(message.every, message.everySample);
  }
};

self.onrtctransform = ({ transformer }: RTCTransformEvent) => {
  const { generation } = transformer.options as CloudTransformOptions;
  void consume(transformer.readable as ReadableStream<RTCEncodedAudioFrame>, generation);
};

setInterval(() => assembler.report(), REPORT_EVERY_MS);

async function beginStream(message: ToCloudWorker & { type: 'cloudStream' }): Promise<void> {
  const codec = await codecReady;
  if (codec === null || message.generation < assembler.generation) return;
  assembler.begin(message.generation, codec);
  assembler.beginStream(codec, message.format, message.header, message.sensor);
}

/** Takes each frame and forwards none. */
async function consume(stream: ReadableStream<RTCEncodedAudioFrame>, generation: number): Promise<void> {
  const codec = await codecReady;
  if (codec === null || generation < assembler.generation) return;
  assembler.begin(generation, codec);
  const reader = stream.getReader();
  for (;;) {
    const { value: frame, done } = await reader.read().catch(() => ({ value: undefined, done: true }));
    // A new session has begun, or this one is over.
    if (done || frame === undefined || assembler.generation !== generation) break;
    const { sequenceNumber, receiveTime = Number.NaN }: AudioFrameMetadata = frame.getMetadata();
    assembler.take(frame.data, sequenceNumber, receiveTime);
  }
  reader.cancel().catch(() => undefined);
}

function takeFromBridge(url: string, generation: number): void {
  bridge ??= new BridgeStream(url, assembler.pool, { flush: (batch) => assembler.handOver(batch) });
  bridge.restart();
  assembler.beginCounting(generation, bridge.intake);
}
