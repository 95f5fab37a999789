import type {
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  SourceDescription,
  SourceFrame,
} from '@farpoint/cloud-source';
import {
  READY_OFFSET,
  REFERENCE_MAX_POINTS,
  ReferenceFrameConsumer,
  type TrustedOwner,
  type WatchOrder,
} from '@farpoint/shared-memory';
import { WATCH_TIMEOUT_MS } from './cloud-shm-source.ts';
import { STANDING, STATIC_CAMERA_POSE } from './playback-source.ts';
import { openWhenThere, ProducerLink } from './producer-link.ts';

export interface ReferenceShmOptions {
  folder: string;
  /** Whose files are used besides this user's own. */
  owner?: TrustedOwner | undefined;
  /** How long to wait for the producer's files, ms. */
  waitMs: number;
}

/**
 * How often its flag is read while a frame is due, ms. Chosen: the frame waits half of it on average; the
 * layout has nothing to wait for.
 */
const LOOK_MS = 0.5;
/** The longer nothing has arrived, the less often it is polled: [idle time, polling interval], ms. */
const IDLE_LOOKS: readonly (readonly [number, number])[] = [
  [10_000, 20],
  [1000, 5],
];
/**
 * Share of the usual frame interval during which there is no polling. Chosen: intervals vary by some tenths;
 * a frame that comes sooner waits until then.
 */
const QUIET_SHARE = 0.6;
/** Weight of the newest interval in the mean. Chosen: it follows another rate within ten frames. */
const SMOOTHING = 0.2;
/**
 * If a producer does not answer the latency flag within this time, the robot makes a frame green itself, ms.
 * Chosen: several intervals of a slow producer.
 */
const LATENCY_ANSWER_MS = 500;

/**
 * The reference system's producer: packed points, taken when its flag is set. It gives neither pose nor capture time.
 */
export class ReferenceShmSource implements FrameSource {
  readonly description: SourceDescription = {
    kind: 'shm (reference layout)',
    width: REFERENCE_MAX_POINTS,
    height: 1,
    capacity: REFERENCE_MAX_POINTS,
    camera: null,
    depthMeasure: 'z',
  };
  readonly state = STANDING;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  readonly #link: ProducerLink<ReferenceFrameConsumer>;
  readonly #now: () => number;
  #readyMs: number;
  #intervalMs = 0;
  #askedMs: number | null = null;

  private constructor(
    consumer: ReferenceFrameConsumer,
    { folder, owner }: ReferenceShmOptions,
    now: () => number,
  ) {
    this.#now = now;
    this.#readyMs = now();
    this.#link = new ProducerLink(consumer, {
      open: () => ReferenceFrameConsumer.open(folder, owner),
      place: ({ flags }) => ({ file: flags, offset: READY_OFFSET, futex: false }),
      order: () => this.#order(),
      onReady: () => {
        const at = this.#now();
        const interval = at - this.#readyMs;
        this.#intervalMs += (interval - this.#intervalMs) * SMOOTHING;
        this.#readyMs = at;
        this.onReady?.();
      },
      onFault: (error) => this.onFault?.(error),
    });
  }

  /** @throws {SharedMemoryError} if no producer appears in time */
  static async open(options: ReferenceShmOptions, now: () => number): Promise<ReferenceShmSource> {
    const { folder, owner, waitMs } = options;
    const consumer = await openWhenThere(() => ReferenceFrameConsumer.open(folder, owner), waitMs);
    return new ReferenceShmSource(consumer, options, now);
  }

  capture(nowMs: number, wishes: CaptureWishes, { points }: CaptureRoom): SourceFrame | null {
    try {
      const frame = this.#link.files?.take(points, this.#tell(nowMs, wishes)) ?? null;
      this.#link.waitForNext();
      if (frame === null || frame.points === 0) return null;
      const unanswered = this.#askedMs !== null && nowMs - this.#askedMs > LATENCY_ANSWER_MS;
      const latencyTest = this.#askedMs !== null && (frame.green || unanswered);
      if (latencyTest) this.#askedMs = null;
      return {
        form: 'points',
        points,
        count: frame.points,
        cameraPose: STATIC_CAMERA_POSE,
        capturedAtMs: this.#readyMs,
        latencyTest,
      };
    } catch (error) {
      this.#link.lost(error);
      return null;
    }
  }

  skip(nowMs: number, wishes: CaptureWishes): void {
    try {
      this.#link.files?.release(this.#tell(nowMs, wishes));
      this.#link.waitForNext();
    } catch (error) {
      this.#link.lost(error);
    }
  }

  close(): void {
    this.#link.close();
  }

  /** Asks the producer for one green frame only, not for green frames until one arrives. */
  #tell(nowMs: number, { bitsPerSecond, latencyTest }: CaptureWishes): CaptureWishes {
    const ask = latencyTest && this.#askedMs === null;
    if (ask) this.#askedMs = nowMs;
    return { bitsPerSecond, latencyTest: ask };
  }

  #order(): WatchOrder {
    const sinceMs = this.#now() - this.#readyMs;
    const pollMs = IDLE_LOOKS.find(([after]) => sinceMs > after)?.[1] ?? LOOK_MS;
    const quietMs = Math.min(Math.max(this.#intervalMs * QUIET_SHARE - sinceMs, 0), WATCH_TIMEOUT_MS / 2);
    return { value: 0, quietMs, pollMs, timeoutMs: WATCH_TIMEOUT_MS };
  }
}
