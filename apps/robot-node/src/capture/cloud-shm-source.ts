import { compose, inverse, type Pose, type Twist } from '@farpoint/protocol';
import { type CloudFrame, CloudReader, PUBLISHED_OFFSET, SharedMemoryError } from '@farpoint/shared-memory';
import type { FrameSource, SourceDescription, SourceFrame, SourceState } from './frame-source.ts';
import { STANDING, STATIC_CAMERA_POSE } from './playback-source.ts';
import { openWhenThere, ProducerLink } from './producer-link.ts';

export interface CloudShmOptions {
  folder: string;
  /** How long to wait for the producer and its first frame, ms. */
  waitMs: number;
}

const WATCH_TIMEOUT_MS = 100;

/** Farpoint's own layout in shared memory: the newest frame, its grid, its pose and its capture time. */
export class CloudShmSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  readonly #link: ProducerLink<CloudReader>;
  readonly #points: Float32Array;
  #state: SourceState = STANDING;
  #readyMs: number;

  private constructor(reader: CloudReader, first: CloudFrame | null, folder: string, now: () => number) {
    const { maxPoints, format, framesPerSecond } = reader.header;
    this.description = {
      kind: `shm (${format})`,
      width: first?.width ?? maxPoints,
      height: first?.height ?? 1,
      capacity: maxPoints,
      depthMeasure: 'z',
      drives: false,
      ...(framesPerSecond > 0 ? { framesPerSecond } : {}),
    };
    this.#points = new Float32Array(maxPoints * 4);
    this.#readyMs = now();
    this.#link = new ProducerLink(reader, {
      open: () => CloudReader.open(folder),
      place: ({ file }) => ({ file, offset: PUBLISHED_OFFSET, futex: true }),
      order: ({ last }) => ({ value: last, timeoutMs: WATCH_TIMEOUT_MS }),
      onReady: () => {
        this.#readyMs = now();
        this.onReady?.();
      },
      onFault: (error) => this.onFault?.(error),
    });
  }

  /** @throws {SharedMemoryError} where there is no producer in time */
  static async open({ folder, waitMs }: CloudShmOptions, now: () => number): Promise<CloudShmSource> {
    const begin = now();
    const reader = await openWhenThere(() => CloudReader.open(folder), waitMs);
    // The first frame says whether there is a grid; a slow camera's is not waited for beyond the time given.
    const points = new Uint32Array(reader.header.maxPoints * 4);
    let first = reader.read(points);
    while (first === null && now() - begin < waitMs) {
      await new Promise((resolve) => setTimeout(resolve, 10));
      first = reader.read(points);
    }
    return new CloudShmSource(reader, first, folder, now);
  }

  get state(): SourceState {
    return this.#state;
  }

  advance(_nowMs: number, _twist: Twist): void {}

  /** @throws {SharedMemoryError} `too-large`: a producer with larger frames has taken over */
  capture(nowMs: number): SourceFrame | null {
    try {
      const frame = this.#link.files?.read(this.#points) ?? null;
      this.#link.waitForNext();
      return frame === null ? null : this.#sourceFrame(frame, nowMs);
    } catch (error) {
      if (error instanceof SharedMemoryError && error.code === 'too-large') throw error;
      this.#link.lost(error);
      return null;
    }
  }

  skip(): void {
    try {
      this.#link.files?.skip();
      this.#link.waitForNext();
    } catch (error) {
      this.#link.lost(error);
    }
  }

  close(): void {
    this.#link.close();
  }

  #sourceFrame(frame: CloudFrame, nowMs: number): SourceFrame {
    const { points, pose, captureMs } = frame;
    const cameraPose: Pose = pose ?? STATIC_CAMERA_POSE;
    // The body is where it would be with the camera a camera without poses has: level, looking ahead, 1 m up.
    if (pose !== null) this.#state = { ...STANDING, pose: compose(pose, inverse(STATIC_CAMERA_POSE)) };
    return {
      points: this.#points,
      count: points,
      cameraPose,
      captureMs: Math.min(captureMs ?? this.#readyMs, nowMs),
    };
  }
}
