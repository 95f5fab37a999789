/**
 * The way of a cloud on the operator's side, from the RTP payloads that the robot's send/clouds/pipeline.ts sends to
 * batches of points for the GPU:
 *
 * 1. take a payload in: check it, and count what is missing (packet-intake.ts),
 * 2. drop it if the decoder is behind (decoder-backlog.ts),
 * 3. decode it with its sensor's and its format's decoder (packet-decoder.ts) into a batch from the pool (batch.ts),
 * 4. hand the batch over when a frame ends, or a few milliseconds later (cloud-receiver.ts, then packages/cloud-view).
 *
 * It is the logic of the cloud worker without the worker: the clock and the timer are arguments.
 */
import { type CloudFormat, MAX_SENSORS, PLACEMENT_BYTES } from '@farpoint/protocol';
import type { Codec } from '@farpoint/wasm-codec';
import type { Batch } from './batch.ts';
import { BatchPool } from './batch-pool.ts';
import { DecoderBacklog } from './decoder-backlog.ts';
import { OrganisedPacketDecoder } from './organised-packet-decoder.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';
import { countDrop, type DropReason, PacketIntake } from './packet-intake.ts';
import { Points64PacketDecoder } from './points64-packet-decoder.ts';
import { UnorganisedPacketDecoder } from './unorganised-packet-decoder.ts';
import type { FromCloudWorker } from './worker-messages.ts';

/** Points are handed over within this time, ms; a frame's last packet causes it at once. */
export const FLUSH_AFTER_MS = 4;
/** With this many undrawn batches the page is behind: fill buffers before handing them over. */
export const BATCHES_AHEAD = 6;
/** All batches: 40 may wait on the page (waiting-batches.ts), the others are being filled or on their way. */
const MAX_BATCHES = 48;
const HEADER_BYTES = 16;

export interface ReceivePipelinePort {
  post(message: FromCloudWorker, transfer: Transferable[]): void;
  /** The worker's `performance.now()`; `timeOriginMs` is its zero in ms since the epoch. */
  nowMs(): number;
  readonly timeOriginMs: number;
  /** Calls `act` once after `afterMs`. */
  setTimer(act: () => void, afterMs: number): number;
  clearTimer(timer: number): void;
}

/** One sensor's decoders: always `points64`, coded formats once their stream header has arrived. */
type Decoders = Partial<Record<CloudFormat, PacketDecoder & Partial<Disposable>>>;

export class ReceivePipeline implements BatchWriter {
  readonly pool = new BatchPool(MAX_BATCHES);
  /** Number of the session; −1 before the first. */
  generation = -1;
  every = 1;
  everySample = 1;
  surface = false;
  readonly #port: ReceivePipelinePort;
  readonly #backlog = new DecoderBacklog();
  #intake = new PacketIntake();
  /** Indexed by sensor number. */
  #decoders: Decoders[] = [];
  #batch: Batch | null = null;
  /** The decoder, and the sensor, whose packets are in the batch. */
  #filling: PacketDecoder | null = null;
  #sensor = 0;
  #flushTimer: number | null = null;
  #busyMs = 0;
  #busyPackets = 0;
  #reportedPackets = -1;

  constructor(port: ReceivePipelinePort) {
    this.#port = port;
  }

  /** Begins a session. Its packets and stream headers take different routes, and whichever is first begins it. */
  begin(generation: number, codec: Codec): void {
    if (generation <= this.generation) return;
    this.beginCounting(generation, new PacketIntake());
    this.#filling?.abandon();
    this.#filling = null;
    this.#batch?.clear();
    for (const decoders of this.#decoders) {
      for (const decoder of Object.values(decoders)) decoder[Symbol.dispose]?.();
    }
    this.#decoders = Array.from({ length: MAX_SENSORS }, () => ({
      points64: new Points64PacketDecoder(codec),
    }));
  }

  /** Begins a session whose packets are decoded elsewhere. @param intake counts them */
  beginCounting(generation: number, intake: PacketIntake): void {
    this.generation = generation;
    this.#intake = intake;
    this.#reportedPackets = -1;
  }

  /** Sets the header with which a format's packets are decoded from now on. */
  beginStream(codec: Codec, format: 'organised' | 'unorganised', header: Uint8Array, sensor = 0): void {
    const decoders = this.#decoders[sensor];
    if (decoders === undefined) return;
    try {
      const Decoder = format === 'organised' ? OrganisedPacketDecoder : UnorganisedPacketDecoder;
      const decoder = new Decoder(codec, header);
      if (this.#filling === decoders[format]) this.#flush();
      decoders[format]?.[Symbol.dispose]?.();
      decoders[format] = decoder;
    } catch (error) {
      const message = error instanceof Error ? error.message : String(error);
      this.#port.post({ type: 'streamRefused', generation: this.generation, format, message }, []);
    }
  }

  /**
   * Takes a payload, and decodes it unless it is faulty or stale.
   *
   * @param payload of one RTP packet
   * @param rtpSequence 16 bits; absent if the browser does not provide it
   * @param receiveTimeMs when it arrived, on the clock of `nowMs`; NaN if the browser does not provide it
   */
  take(payload: ArrayBuffer, rtpSequence: number | undefined, receiveTimeMs: number): void {
    const beganMs = this.#port.nowMs();
    const fault = this.#intake.take(new DataView(payload), rtpSequence);
    if (fault === null) {
      if (this.#backlog.isStale(beganMs - receiveTimeMs)) this.drop('decoder-behind');
      else this.#decode(payload, this.#port.timeOriginMs + beganMs - this.#backlog.waitedMs);
    }
    this.#busyMs += this.#port.nowMs() - beganMs;
    this.#busyPackets++;
  }

  /** From now on hands on only one of every `every` points, of `points64` one of every `everySample`. */
  drawEvery(every: number, everySample: number): void {
    this.#flush();
    this.every = every;
    this.everySample = everySample;
  }

  /** From the next frames on hands clouds on a camera's grid on as tiles of a surface, or as points. */
  drawSurface(wanted: boolean): void {
    this.surface = wanted;
  }

  /** The page returned a buffer. */
  giveBack(buffer: ArrayBuffer): void {
    this.pool.giveBack(buffer);
    if (this.#batch !== null && this.#flushTimer === null && this.pool.out < BATCHES_AHEAD)
      this.#scheduleFlush();
  }

  /** Hands a filled batch over. */
  handOver({ buffer, packets, pointCount: points, sensor }: Batch): void {
    const { generation } = this;
    this.pool.sent();
    this.#port.post({ type: 'batch', generation, sensor, packets, points, buffer }, [buffer]);
  }

  /** Reports the session's totals, if packets have arrived since the last report. */
  report(): void {
    const { packetsReceived, bytesReceived, packetsLost, drops } = this.#intake;
    if (this.generation < 0 || packetsReceived === this.#reportedPackets) return;
    this.#reportedPackets = packetsReceived;
    const decodeUs = this.#busyPackets === 0 ? 0 : (this.#busyMs * 1000) / this.#busyPackets;
    this.#busyMs = 0;
    this.#busyPackets = 0;
    const sums = { packetsReceived, bytesReceived, packetsLost, drops, decodeUs };
    this.#port.post({ type: 'report', generation: this.generation, ...sums }, []);
  }

  batchFor(wanted: number): Batch | null {
    const batch = this.#batch;
    if (batch !== null && (batch.full || (batch.pointCount > 0 && wanted > batch.room))) this.#flush();
    this.#batch ??= this.pool.take();
    if (this.#batch !== null) this.#batch.sensor = this.#sensor;
    return this.#batch;
  }

  drop(reason: DropReason): void {
    countDrop(this.#intake.drops, reason);
  }

  #decode(payload: ArrayBuffer, receivedAtMs: number): void {
    const { header, placement } = this.#intake;
    const decoder = this.#decoders[placement.sensor]?.[placement.format];
    if (decoder === undefined) {
      this.drop('no-stream');
      return;
    }
    if (this.#filling !== decoder) {
      this.#flush();
      this.#filling = decoder;
      this.#sensor = placement.sensor;
    }
    const bytes = new Uint8Array(payload, HEADER_BYTES, payload.byteLength - HEADER_BYTES - PLACEMENT_BYTES);
    decoder.add(header, placement, bytes, receivedAtMs, this);
    const lastOfFrame = header.sequenceOffset + header.sequenceLength === header.frameLength;
    if (lastOfFrame && this.pool.out < BATCHES_AHEAD) this.#flush();
    else this.#scheduleFlush();
  }

  #scheduleFlush(): void {
    this.#flushTimer ??= this.#port.setTimer(() => {
      this.#flushTimer = null;
      const beganMs = this.#port.nowMs();
      this.#filling?.settle(this);
      this.#busyMs += this.#port.nowMs() - beganMs;
      // Otherwise it is handed over when a buffer comes back or when it is full.
      if (this.pool.out < BATCHES_AHEAD) this.#flush();
    }, FLUSH_AFTER_MS);
  }

  #flush(): void {
    if (this.#flushTimer !== null) this.#port.clearTimer(this.#flushTimer);
    this.#flushTimer = null;
    // This may itself hand over batches that it fills.
    this.#filling?.settle(this);
    const batch = this.#batch;
    if (batch === null || batch.packets === 0) return;
    this.#filling?.finish(batch);
    this.#batch = null;
    this.handOver(batch);
  }
}
