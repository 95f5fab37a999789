/// <reference lib="webworker" />
/**
 * The cloud's worker: takes encoded frames from the receiver, one RTP payload each, never forwards them, unpacks the
 * points and hands them to the page by transfer.
 */
import { CloudDecoder, loadCodec } from '@farpoint/wasm-codec';
import { BridgeStream } from '../bridge/bridge-stream.ts';
import { BATCH_PACKETS, type Batch } from './batch.ts';
import { BatchPool } from './batch-pool.ts';
import { ImageExtent } from './image-extent.ts';
import { countDrop, PacketIntake } from './packet-intake.ts';
import type { CloudTransformOptions, FromCloudWorker, ToCloudWorker } from './worker-messages.ts';

declare const self: DedicatedWorkerGlobalScope & {
  onrtctransform: ((event: RTCTransformEvent) => void) | null;
};

/** A burst that has begun is handed over after so long at the latest, ms; a frame's last packet does not wait. */
const FLUSH_AFTER_MS = 4;
/** With so many batches undrawn the page is slower than we are: fill buffers before handing over. */
const BATCHES_AHEAD = 6;
const MAX_BATCHES = 48;
const REPORT_EVERY_MS = 100;
const HEADER_BYTES = 16;

const pool = new BatchPool(MAX_BATCHES);
const codecReady = loadCodec().then((codec) => new CloudDecoder(codec, BATCH_PACKETS));
codecReady.then(
  () => post({ type: 'ready' }),
  (error: unknown) =>
    post({ type: 'failed', message: error instanceof Error ? error.message : String(error) }),
);

let generation = -1;
let intake = new PacketIntake();
let extent = new ImageExtent();
let batch: Batch | null = null;
let bridge: BridgeStream | null = null;
let flushTimer: ReturnType<typeof setTimeout> | undefined;
let busyMs = 0;
let busyPackets = 0;
let reportedPackets = -1;

function post(message: FromCloudWorker, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

self.onmessage = (event: MessageEvent<ToCloudWorker>) => {
  const message = event.data;
  if (message.type === 'return') {
    pool.giveBack(message.buffer);
    if (batch !== null && flushTimer === undefined && pool.out < BATCHES_AHEAD) scheduleFlush();
  } else if (message.type === 'bridge') {
    takeFromBridge(message.url, message.generation);
  } else {
    void consume(message.readable, message.generation);
  }
};

function takeFromBridge(url: string, of: number): void {
  generation = of;
  bridge ??= new BridgeStream(url, pool, {
    flush: ({ buffer, packets, pointCount: points }) => {
      pool.sent();
      post({ type: 'batch', generation, packets, points, buffer }, [buffer]);
    },
  });
  bridge.restart();
  intake = bridge.intake;
  reportedPackets = -1;
}

self.onrtctransform = (event: RTCTransformEvent) => {
  const { generation } = event.transformer.options as CloudTransformOptions;
  void consume(event.transformer.readable as ReadableStream<RTCEncodedAudioFrame>, generation);
};

async function consume(stream: ReadableStream<RTCEncodedAudioFrame>, of: number): Promise<void> {
  const decoder = await codecReady.catch(() => null);
  if (decoder === null || of < generation) return;
  generation = of;
  intake = new PacketIntake();
  extent = new ImageExtent();
  reportedPackets = -1;
  abandonBatch(decoder);
  const reader = stream.getReader();
  for (;;) {
    const { value: frame, done } = await reader.read().catch(() => ({ value: undefined, done: true }));
    // A new session has begun, or this one is over.
    if (done || frame === undefined || generation !== of) break;
    receive(frame, decoder);
  }
  reader.cancel().catch(() => undefined);
}

function receive(frame: RTCEncodedAudioFrame, decoder: CloudDecoder): void {
  const began = performance.now();
  const { data } = frame;
  const payload = new DataView(data);
  const fault = intake.take(payload, frame.getMetadata().sequenceNumber);
  if (fault === null) {
    batch ??= pool.take();
    if (batch === null) {
      countDrop(intake.drops, 'no-buffer');
    } else {
      const { header } = intake;
      decoder.put(new Uint8Array(data, HEADER_BYTES, header.sequenceLength));
      extent.add(header.frameNumber, payload, HEADER_BYTES, header.sequenceLength / 8);
      batch.add(header, intake.placement, performance.timeOrigin + began, extent.value);
      const lastOfFrame = header.sequenceOffset + header.sequenceLength === header.frameLength;
      if (batch.full || (lastOfFrame && pool.out < BATCHES_AHEAD)) flush(decoder);
      else scheduleFlush();
    }
  }
  busyMs += performance.now() - began;
  busyPackets++;
}

function scheduleFlush(): void {
  flushTimer ??= setTimeout(() => {
    flushTimer = undefined;
    // Otherwise the next buffer that comes back, or a full one, brings it on its way.
    if (pool.out < BATCHES_AHEAD) void codecReady.then(flush);
  }, FLUSH_AFTER_MS);
}

function flush(decoder: CloudDecoder): void {
  clearTimeout(flushTimer);
  flushTimer = undefined;
  if (batch === null) return;
  batch.points.set(decoder.unpack());
  const { buffer, packets, pointCount: points } = batch;
  batch = null;
  pool.sent();
  post({ type: 'batch', generation, packets, points, buffer }, [buffer]);
}

/** What an earlier session left undecoded. */
function abandonBatch(decoder: CloudDecoder): void {
  if (batch === null) return;
  decoder.unpack();
  batch.clear();
}

setInterval(() => {
  if (generation < 0 || intake.packetsReceived === reportedPackets) return;
  reportedPackets = intake.packetsReceived;
  const { packetsReceived, bytesReceived, packetsLost, drops } = intake;
  const decodeUs = busyPackets === 0 ? 0 : (busyMs * 1000) / busyPackets;
  busyMs = 0;
  busyPackets = 0;
  post({ type: 'report', generation, packetsReceived, bytesReceived, packetsLost, drops, decodeUs });
}, REPORT_EVERY_MS);
