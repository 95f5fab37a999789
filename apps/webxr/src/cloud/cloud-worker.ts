/// <reference lib="webworker" />
/**
 * The cloud's worker: takes encoded frames from the receiver, one RTP payload each, never forwards them, unpacks the
 * points and hands them to the page by transfer.
 */
import { type CloudFormat, PLACEMENT_BYTES } from '@farpoint/protocol';
import { type Codec, loadCodec } from '@farpoint/wasm-codec';
import { BridgeStream } from '../bridge/bridge-stream.ts';
import type { Batch } from './batch.ts';
import { BatchPool } from './batch-pool.ts';
import { DecoderBacklog } from './decoder-backlog.ts';
import { OrganisedPacketDecoder } from './organised-packet-decoder.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';
import { countDrop, PacketIntake } from './packet-intake.ts';
import { Points64PacketDecoder } from './points64-packet-decoder.ts';
import { UnorganisedPacketDecoder } from './unorganised-packet-decoder.ts';
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
const codecReady = loadCodec();
codecReady.then(
  () => post({ type: 'ready' }),
  (error: unknown) =>
    post({ type: 'failed', message: error instanceof Error ? error.message : String(error) }),
);

/** https://w3c.github.io/webrtc-encoded-transform/ */
interface AudioFrameMetadata extends RTCEncodedAudioFrameMetadata {
  /** When the packet came, as `performance.now()`; where the browser tells. */
  receiveTime?: number;
}

const backlog = new DecoderBacklog();
let generation = -1;
let intake = new PacketIntake();
/** Of coded formats, once their stream header has come. */
const decoders: Partial<Record<CloudFormat, PacketDecoder & Partial<Disposable>>> = {};
let batch: Batch | null = null;
let bridge: BridgeStream | null = null;
/** Whose packets are in the batch. */
let filling: PacketDecoder | null = null;
let every = 1;
let everySample = 1;
let flushTimer: ReturnType<typeof setTimeout> | undefined;
let busyMs = 0;
let busyPackets = 0;
let reportedPackets = -1;

function post(message: FromCloudWorker, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

self.onmessage = (event: MessageEvent<ToCloudWorker>) => {
  const message = event.data;
  switch (message.type) {
    case 'return':
      pool.giveBack(message.buffer);
      if (batch !== null && flushTimer === undefined && pool.out < BATCHES_AHEAD) scheduleFlush();
      return;
    case 'stream':
      void consume(message.readable, message.generation);
      return;
    case 'cloudStream':
      void beginCodedStream(message);
      return;
    case 'bridge':
      takeFromBridge(message.url, message.generation);
      return;
    case 'drawEvery':
      flush();
      ({ every, everySample } = message);
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

async function beginCodedStream(message: ToCloudWorker & { type: 'cloudStream' }): Promise<void> {
  const codec = await codecReady.catch(() => null);
  if (codec === null || message.generation < generation) return;
  if (message.generation > generation) beginGeneration(message.generation, codec);
  const { format, header } = message;
  try {
    const Decoder = format === 'organised' ? OrganisedPacketDecoder : UnorganisedPacketDecoder;
    const decoder = new Decoder(codec, header);
    if (filling === decoders[format]) flush();
    decoders[format]?.[Symbol.dispose]?.();
    decoders[format] = decoder;
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    post({ type: 'streamRefused', generation, format, message: text });
  }
}

self.onrtctransform = (event: RTCTransformEvent) => {
  const { generation } = event.transformer.options as CloudTransformOptions;
  void consume(event.transformer.readable as ReadableStream<RTCEncodedAudioFrame>, generation);
};

async function consume(stream: ReadableStream<RTCEncodedAudioFrame>, of: number): Promise<void> {
  const codec = await codecReady.catch(() => null);
  if (codec === null || of < generation) return;
  if (of > generation) beginGeneration(of, codec);
  const reader = stream.getReader();
  for (;;) {
    const { value: frame, done } = await reader.read().catch(() => ({ value: undefined, done: true }));
    // A new session has begun, or this one is over.
    if (done || frame === undefined || generation !== of) break;
    receive(frame);
  }
  reader.cancel().catch(() => undefined);
}

/** A session's packets and its stream header come on different ways: whichever is first begins it. */
function beginGeneration(of: number, codec: Codec): void {
  generation = of;
  intake = new PacketIntake();
  reportedPackets = -1;
  filling?.abandon();
  filling = null;
  batch?.clear();
  for (const format of ['organised', 'unorganised'] as const) {
    decoders[format]?.[Symbol.dispose]?.();
    delete decoders[format];
  }
  decoders.points64 = new Points64PacketDecoder(codec);
}

const writer: BatchWriter = {
  get every() {
    return every;
  },
  get everySample() {
    return everySample;
  },
  batchFor(wanted) {
    if (batch !== null && (batch.full || (batch.pointCount > 0 && wanted > batch.room))) flush();
    batch ??= pool.take();
    return batch;
  },
  drop(reason) {
    countDrop(intake.drops, reason);
  },
};

function receive(frame: RTCEncodedAudioFrame): void {
  const began = performance.now();
  const { data } = frame;
  const { sequenceNumber, receiveTime = Number.NaN }: AudioFrameMetadata = frame.getMetadata();
  const fault = intake.take(new DataView(data), sequenceNumber);
  if (fault === null) {
    if (backlog.isStale(began - receiveTime)) writer.drop('decoder-behind');
    else decode(data, performance.timeOrigin + began);
  }
  busyMs += performance.now() - began;
  busyPackets++;
}

function decode(data: ArrayBuffer, receivedMs: number): void {
  const { header, placement } = intake;
  const decoder = decoders[placement.format];
  if (decoder === undefined) {
    writer.drop('no-stream');
    return;
  }
  if (filling !== decoder) {
    flush();
    filling = decoder;
  }
  const bytes = new Uint8Array(data, HEADER_BYTES, data.byteLength - HEADER_BYTES - PLACEMENT_BYTES);
  decoder.add(header, placement, bytes, receivedMs, writer);
  const lastOfFrame = header.sequenceOffset + header.sequenceLength === header.frameLength;
  if (lastOfFrame && pool.out < BATCHES_AHEAD) flush();
  else scheduleFlush();
}

function scheduleFlush(): void {
  flushTimer ??= setTimeout(() => {
    flushTimer = undefined;
    const began = performance.now();
    filling?.settle(writer);
    busyMs += performance.now() - began;
    // Otherwise the next buffer that comes back, or a full one, brings it on its way.
    if (pool.out < BATCHES_AHEAD) flush();
  }, FLUSH_AFTER_MS);
}

function flush(): void {
  clearTimeout(flushTimer);
  flushTimer = undefined;
  // This may itself hand over batches that it fills.
  filling?.settle(writer);
  if (batch === null || batch.packets === 0) return;
  filling?.finish(batch);
  const { buffer, packets, pointCount: points } = batch;
  batch = null;
  pool.sent();
  post({ type: 'batch', generation, packets, points, buffer }, [buffer]);
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
