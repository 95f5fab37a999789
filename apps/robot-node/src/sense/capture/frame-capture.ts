import { nextSequence32, packetCountOf } from '@farpoint/protocol';
import type { CloudTap } from '@farpoint/recording';
import { EvenPace } from '@farpoint/timing';
import type { Codec } from '@farpoint/wasm-codec';
import type { CaptureBudget } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import { type FormattedFrame, FrameFormats } from '../encode/frame-formats.ts';
import { SLOT_BYTES } from '../encode/packetiser.ts';
import { FramePlanner } from '../encode/plan.ts';
import type { SensorGuard } from '../obstacles/sensor-guard.ts';
import type { CaptureWishes, FrameSource, SourceFrame } from '../sources/frame-source.ts';
import { BufferPool } from './buffer-pool.ts';
import type { CaptureOptions, ReportSink } from './capture-messages.ts';
import type { CapturePictures } from './capture-pictures.ts';

/** One frame being sent, one waiting, one being filled, and one more because some frames are sent in two formats. */
const BUFFERS = 4;
/** Weight of the latest frame in the moving average of the time per frame. */
const SMOOTHING = 0.1;
/** While nobody drives, clouds that are sent are judged at most this often, ms: operators see what is near the robot. */
const JUDGED_EVERY_MS = 200;
/** While the robot moves, and its clouds come faster than a camera's 30/s, not each is judged, ms. */
const GUARDED_EVERY_MS = 25;

/** The clocks that capturing reads, ms. */
export interface CaptureClocks {
  /** The robot's clock. */
  now: () => number;
  /** Processor time of this thread. */
  threadCpu: () => number;
}

/** Takes one cloud at a time from the source, encodes it to the budget, and sends its packets in a pooled buffer. */
export class FrameCapture {
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
    const buffer = this.#pool.take();
    if (buffer === null) return null;
    this.#pool.release(buffer);
    const { now, threadCpu } = this.#clocks;
    const beganMs = now();
    const cpuBefore = threadCpu();
    const room = this.#formats.room(budget.coded.length > 0);
    const frame = this.#source.capture(beganMs, this.wishes(budget), room);
    if (frame === null) return null;
    this.#judge(frame, beganMs);
    const taken = { captureMs: now() - beganMs, captureCpuMs: threadCpu() - cpuBefore };
    const latencyTest = this.#latencyTest && frame.latencyTest !== false;
    const frameNumber = this.#frameNumber;
    const probeBytes = this.#probeBytes(budget);
    const workMs = this.#workMs;
    const request = { frameNumber, budget, probeBytes, workMs, measuredFramesPerSecond, latencyTest };
    const encoded = this.#formats.encode(frame, request);
    this.#frameNumber = nextSequence32(frameNumber);
    this.#announceStream();
    const { intervalMs, usefulBitsPerSecond } = encoded;
    const facts = {
      usefulBitsPerSecond,
      intervalMs,
      latencyTest,
      capturedAtMs: frame.capturedAtMs,
      ...taken,
    };
    if (!budget.unsent) for (const formatted of encoded.frames) this.#sendFrame(formatted, facts);
    if (frame.form === 'images') this.#pictures.offer(frame);
    this.#record(frame, budget.unsent ? [] : encoded.frames);
    this.#guard?.lookDown(now(), this.#guarding);
    if (latencyTest) this.#latencyTest = false;
    const work = workOf(now() - beganMs, threadCpu() - cpuBefore, this.#anyRate);
    this.#workMs += (work - workMs) * (workMs === 0 ? 1 : SMOOTHING);
    return intervalMs;
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

/** The part of a frame's report that does not come from encoding it. */
interface FrameFacts {
  usefulBitsPerSecond: number;
  intervalMs: number;
  latencyTest: boolean;
  capturedAtMs: number;
  captureMs: number;
  captureCpuMs: number;
}

/** How much of the time that a frame waits for busy processors counts as its own, for a source that is asked. */
const WAITING_SHARE = 0.75;

/**
 * The time that counts as a frame's work. A source with its own timing must be ready before its next cloud, by the clock. One
 * that is asked takes its share of the processor, whoever else uses it: only when it waits for most of the time does that
 * count, so that it is asked less often.
 */
export function workOf(wallMs: number, cpuMs: number, anyRate: boolean): number {
  return anyRate ? Math.max(cpuMs, WAITING_SHARE * wallMs) : wallMs;
}
