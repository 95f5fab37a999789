/**
 * The way of a cloud on the capture thread, from its source to a buffer of packets:
 *
 * 1. take it from the source (sources/frame-source.ts),
 * 2. let the obstacle guard judge it (obstacles/sensor-guard.ts),
 * 3. plan, sample, encode and packetise it (encode/frame-formats.ts),
 * 4. announce the header of a new coded stream,
 * 5. send the packets to the main thread, where send/clouds/pipeline.ts goes on,
 * 6. offer its colour picture, and record it.
 */

import type { CaptureWishes, FrameSource, SourceFrame } from '@farpoint/cloud-source';
import { nextSequence32, packetCountOf } from '@farpoint/protocol';
import type { CloudTap } from '@farpoint/recording';
import { EvenPace } from '@farpoint/timing';
import type { Codec } from '@farpoint/wasm-codec';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import { type FormattedFrame, type FormattedFrames, FrameFormats } from '../encode/frame-formats.ts';
import { SLOT_BYTES } from '../encode/packetiser.ts';
import { FramePlanner } from '../encode/plan.ts';
import type { SensorGuard } from '../obstacles/sensor-guard.ts';
import { BufferPool } from './buffer-pool.ts';
import type { CaptureOptions, ReportSink } from './capture-messages.ts';
import type { CapturePictures } from './capture-pictures.ts';

/** One frame being sent, one waiting, one being filled, and one more because some frames are sent in two formats. */
const BUFFERS = 4;
/** Weight of the latest frame in the moving average of the time per frame. */
const SMOOTHING = 0.1;
/**
 * While nobody drives, clouds that are sent are judged at most this often, ms: operators see what is near the
 * robot. Five times a second instead of ten: docs/decisions/2026-11-28-cost-of-a-frame.md.
 */
const JUDGED_EVERY_MS = 200;
/**
 * While the robot moves, and its clouds come faster than a camera's 30/s, not each is judged, ms. At 30/s
 * nothing changes: docs/decisions/2026-11-28-cost-of-a-frame.md.
 */
const GUARDED_EVERY_MS = 25;

/** The clocks that capturing reads, ms. */
export interface CaptureClocks {
  /** The robot's clock. */
  now: () => number;
  /** Processor time of this thread. */
  threadCpu: () => number;
}

/** Takes one cloud at a time from the source, encodes it to the budget, and sends its packets in a pooled buffer. */
export class CapturePipeline {
  readonly #source: FrameSource;
  readonly #sensor: number;
  readonly #clocks: CaptureClocks;
  readonly #send: ReportSink;
  readonly #pictures: CapturePictures;
  readonly #recording: CloudTap | null;
  readonly #guard: SensorGuard | null;
  #guarding = false;
  readonly #judging = new EvenPace();
  readonly #pool: BufferPool;
  readonly #formats: FrameFormats;
  #frameNumber = 0;
  /** The stream that was last reported to the main thread. */
  #stream: CodedStream | null = null;
  /** The cluster of the probe for which a frame was last enlarged. */
  #probeCluster = 0;
  /** Moving average of the time that a frame takes, ms ({@link workOf}). */
  #workMs = 0;
  readonly #anyRate: boolean;
  #latencyTest = false;

  constructor(
    source: FrameSource,
    codec: Codec,
    options: Omit<CaptureOptions, 'source'>,
    clocks: CaptureClocks,
    send: ReportSink,
    /** Other receivers of the clouds. */
    {
      pictures,
      recording,
      guard,
    }: { pictures: CapturePictures; recording: CloudTap | null; guard: SensorGuard | null },
  ) {
    const { description } = source;
    const { plan, framesPerSecond, floorFraction, mostPoints, sampling, sensor } = options;
    this.#source = source;
    this.#sensor = sensor;
    this.#clocks = clocks;
    this.#send = send;
    this.#pictures = pictures;
    this.#recording = recording;
    this.#guard = guard;
    this.#pool = new BufferPool(BUFFERS, packetCountOf(description.capacity) * SLOT_BYTES);
    this.#anyRate = source.onReady === undefined;
    const planner = new FramePlanner({
      policy: plan,
      mostFramesPerSecond: Math.min(framesPerSecond, description.framesPerSecond ?? framesPerSecond),
      anyRate: this.#anyRate,
      floorFraction,
      mostPoints,
    });
    this.#formats = new FrameFormats(codec, description, { ...sampling, sensor }, planner, clocks.now);
  }

  /** Whether a buffer is free for the next frame. */
  get hasRoom(): boolean {
    return this.#pool.free > 0;
  }

  /** Frames not sent because all buffers were in use. */
  get framesWithoutBuffer(): number {
    return this.#pool.refused;
  }

  /** Makes the next cloud a green latency-test cloud, if the source can. */
  requestLatencyTest(): void {
    this.#latencyTest = true;
  }

  /** Returns a frame's buffer to the pool. */
  recycle(buffer: ArrayBuffer): void {
    this.#pool.release(buffer);
  }

  /** What the source is told when it is asked for a cloud, or told to skip one. */
  wishes({ targetBitsPerSecond }: CaptureBudget): CaptureWishes {
    return { bitsPerSecond: targetBitsPerSecond, latencyTest: this.#latencyTest };
  }

  /**
   * Captures and encodes one frame.
   *
   * @param measuredFramesPerSecond how often clouds have come of late; `null` while that is not known
   * @returns the time until the next one, ms; `null` if there was no cloud or no buffer
   */
  capture(budget: CaptureBudget, measuredFramesPerSecond: number | null): number | null {
    if (!this.#pool.admits()) return null;
    const began = this.#clockTimes();
    const room = this.#formats.room(budget.coded.length > 0);
    const frame = this.#source.capture(began.wallMs, this.wishes(budget), room);
    if (frame === null) return null;
    const inMemoryMs = this.#clocks.now();
    this.#judge(frame, began.wallMs);
    const taken = this.#since(began);
    const latencyTest = this.#latencyTest && frame.latencyTest !== false;
    const encoded = this.#encode(frame, budget, measuredFramesPerSecond, latencyTest);
    this.#announceStream();
    const sent = budget.unsent ? [] : encoded.frames;
    const facts = {
      usefulBitsPerSecond: encoded.usefulBitsPerSecond,
      intervalMs: encoded.intervalMs,
      latencyTest,
      capturedAtMs: frame.capturedAtMs,
      inMemoryMs,
      captureMs: taken.wallMs,
      captureCpuMs: taken.cpuMs,
    };
    for (const formatted of sent) this.#sendFrame(formatted, facts);
    if (frame.form === 'images') this.#pictures.offer(frame);
    this.#record(frame, sent);
    this.#guard?.lookDown(this.#clocks.now(), this.#guarding);
    if (latencyTest) this.#latencyTest = false;
    this.#addWork(this.#since(began));
    return encoded.intervalMs;
  }

  #clockTimes(): ClockTimes {
    return { wallMs: this.#clocks.now(), cpuMs: this.#clocks.threadCpu() };
  }

  #since(began: ClockTimes): ClockTimes {
    const { wallMs, cpuMs } = this.#clockTimes();
    return { wallMs: wallMs - began.wallMs, cpuMs: cpuMs - began.cpuMs };
  }

  #encode(
    frame: SourceFrame,
    budget: CaptureBudget,
    measuredFramesPerSecond: number | null,
    latencyTest: boolean,
  ): FormattedFrames {
    const frameNumber = this.#frameNumber;
    this.#frameNumber = nextSequence32(frameNumber);
    return this.#formats.encode(frame, {
      frameNumber,
      budget,
      probeBytes: this.#probeBytes(budget),
      workMs: this.#workMs,
      measuredFramesPerSecond,
      latencyTest,
    });
  }

  #addWork({ wallMs, cpuMs }: ClockTimes): void {
    const work = workOf(wallMs, cpuMs, this.#anyRate);
    this.#workMs += (work - this.#workMs) * (this.#workMs === 0 ? 1 : SMOOTHING);
  }

  /** Whether the obstacle guard needs every cloud, and some that are not sent. */
  guard(wanted: boolean): void {
    const guarding = wanted && this.#guard !== null;
    if (guarding === this.#guarding) return;
    this.#guarding = guarding;
    this.#judging.reset();
  }

  get guarding(): boolean {
    return this.#guarding;
  }

  /** Captures a cloud for the obstacle guard only. */
  look(budget: CaptureBudget): void {
    const wishes = { ...this.wishes(budget), latencyTest: false };
    const frame = this.#source.capture(this.#clocks.now(), wishes, this.#formats.room(false));
    if (frame !== null) this.#guard?.take(frame);
    this.#guard?.lookDown(this.#clocks.now(), this.#guarding);
  }

  #judge(frame: SourceFrame, nowMs: number): void {
    const everyMs = this.#guarding ? GUARDED_EVERY_MS : JUDGED_EVERY_MS;
    if (!this.#judging.takes(nowMs, everyMs)) return;
    this.#judging.taken(nowMs, everyMs);
    this.#guard?.take(frame);
  }

  close(): void {
    this.#guard?.[Symbol.dispose]();
    this.#pictures.close();
    this.#recording?.close();
  }

  /** Each probe enlarges one frame. */
  #probeBytes({ probe }: CaptureBudget): number {
    if (probe === null || probe.clusterId === this.#probeCluster) return 0;
    this.#probeCluster = probe.clusterId;
    return probe.bytes;
  }

  /** Receivers must know a stream's header before its first packet. */
  #announceStream(): void {
    const { stream } = this.#formats;
    if (stream === null || stream === this.#stream) return;
    this.#stream = stream;
    this.#send({ type: 'stream', stream });
  }

  #sendFrame({ encoded, audience, packets }: FormattedFrame, facts: FrameFacts): void {
    const buffer = this.#pool.take();
    if (buffer === null) return;
    packets.copyPackets(new Uint8Array(buffer), encoded.packets);
    const readyMs = this.#clocks.now();
    const sensor = this.#sensor;
    this.#send({ type: 'frame', ...encoded, ...facts, sensor, audience, buffer, readyMs }, [buffer]);
  }

  /** Called after the packets have been sent, so that recording delays only the next cloud. */
  #record(frame: SourceFrame, formatted: readonly FormattedFrame[]): void {
    const recording = this.#recording;
    if (recording === null) return;
    recording.captured(frame, this.#source.description);
    for (const { encoded, packets } of formatted) {
      const { format, points, packets: count } = encoded;
      recording.sent(frame, {
        format,
        points,
        packets: count,
        slotBytes: SLOT_BYTES,
        streamHeader: format === 'points64' ? null : (this.#stream?.header ?? null),
        copyPackets: (buffer, n) => packets.copyPackets(buffer, n),
      });
    }
  }
}

/** Of the wall clock and of this thread's processor time. */
interface ClockTimes {
  wallMs: number;
  cpuMs: number;
}

/** The part of a frame's report that does not come from encoding it. */
interface FrameFacts {
  usefulBitsPerSecond: number;
  intervalMs: number;
  latencyTest: boolean;
  capturedAtMs: number;
  inMemoryMs: number;
  captureMs: number;
  captureCpuMs: number;
}

/**
 * How much of the time that a frame waits for busy processors counts as its own, for a source that is asked.
 * `pnpm bench link`: with 0.85 and 1, the median is 1 and 3 ms earlier, for 4 and 8 frames a second less
 * (docs/decisions/2026-11-28-cost-of-a-frame.md).
 */
const WAITING_SHARE = 0.75;

/**
 * The time that counts as a frame's work. A source with its own timing must be ready before its next cloud, by the clock. One
 * that is asked takes its share of the processor, whoever else uses it: only when it waits for most of the time does that
 * count, so that it is asked less often.
 */
export function workOf(wallMs: number, cpuMs: number, anyRate: boolean): number {
  return anyRate ? Math.max(cpuMs, WAITING_SHARE * wallMs) : wallMs;
}
