import type {
  BaseState,
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  Mounted,
  SourceDescription,
  SourceFrame,
} from '@farpoint/cloud-source';
import { compose, inverse, type Pose } from '@farpoint/protocol';
import {
  type CloudFrame,
  CloudReader,
  type FrameRoom,
  PUBLISHED_OFFSET,
  SharedMemoryError,
  type TrustedOwner,
} from '@farpoint/shared-memory';
import { MOST_AHEAD_MS, REFUSED_AGE_MS } from '../../ground/ros/stamp-clock.ts';
import { STANDING, STATIC_CAMERA_POSE } from './playback-source.ts';
import { openWhenThere, ProducerLink } from './producer-link.ts';

export interface CloudShmOptions {
  folder: string;
  /** Whose files are used besides this user's own. */
  owner?: TrustedOwner | undefined;
  /** How long to wait for the producer and its first frame, ms. */
  waitMs: number;
}

/**
 * How often the source looks for its producer while no frame comes, ms. Chosen: a producer that ended is
 * noticed before the sensor counts as silent (400 ms).
 */
export const WATCH_TIMEOUT_MS = 100;

/** Farpoint's own layout in shared memory: the newest frame with its grid, pose and capture time. */
export class CloudShmSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  readonly #link: ProducerLink<CloudReader>;
  readonly #mount: Pose;
  #state: BaseState = { ...STANDING, measuredMs: null };
  #readyMs: number;

  private constructor(
    reader: CloudReader,
    first: CloudFrame | null,
    { folder, owner, mount = null }: CloudShmOptions & Mounted,
    now: () => number,
  ) {
    const { maxPoints, format, framesPerSecond } = reader.header;
    // For the picture only: where nobody has said how the camera is mounted, nothing rests on where the robot is.
    this.#mount = mount ?? STATIC_CAMERA_POSE;
    this.description = {
      kind: `shm (${format})`,
      width: first?.width ?? maxPoints,
      height: first?.height ?? 1,
      capacity: maxPoints,
      camera: first?.lens ?? null,
      depthMeasure: 'z',
      ...(framesPerSecond > 0 ? { framesPerSecond } : {}),
    };
    this.#readyMs = now();
    this.#link = new ProducerLink(reader, {
      open: () => CloudReader.open(folder, owner),
      place: ({ file }) => ({ file, offset: PUBLISHED_OFFSET, futex: true }),
      order: ({ last }) => ({ value: last, timeoutMs: WATCH_TIMEOUT_MS }),
      onReady: () => {
        this.#readyMs = now();
        this.onReady?.();
      },
      onFault: (error) => this.onFault?.(error),
    });
  }

  /** @throws {SharedMemoryError} if no producer appears in time */
  static async open(options: CloudShmOptions & Mounted, now: () => number): Promise<CloudShmSource> {
    const { folder, owner, waitMs } = options;
    const begin = now();
    const reader = await openWhenThere(() => CloudReader.open(folder, owner), waitMs);
    // The first frame shows whether there are a grid and a lens. A slow camera's first frame is not awaited beyond
    // the given time.
    const room = roomFor(reader.header.maxPoints);
    let first = reader.read(room);
    while (first === null && now() - begin < waitMs) {
      await new Promise((resolve) => setTimeout(resolve, 10));
      first = reader.read(room);
    }
    return new CloudShmSource(reader, first, options, now);
  }

  get state(): BaseState {
    return this.#state;
  }

  /** @throws {Error} if a producer with another camera or larger frames has taken over */
  capture(nowMs: number, _wishes: CaptureWishes, room: CaptureRoom): SourceFrame | null {
    let frame: CloudFrame | null;
    try {
      frame = this.#link.files?.read(room) ?? null;
      this.#link.waitForNext();
    } catch (error) {
      if (error instanceof SharedMemoryError && error.code === 'too-large') throw error;
      this.#link.lost(error);
      return null;
    }
    if (frame === null) return null;
    this.#checkCamera(frame);
    return this.#sourceFrame(frame, nowMs, room);
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

  /** The encoder was made for one camera. Another camera needs a restart of the robot. */
  #checkCamera({ lens, width, height }: CloudFrame): void {
    const { camera } = this.description;
    const same =
      camera === null || lens === null
        ? camera === lens
        : width === this.description.width &&
          height === this.description.height &&
          (['fx', 'fy', 'cx', 'cy'] as const).every((key) => camera[key] === lens[key]);
    if (!same) throw new Error('the camera in shared memory has changed: restart the robot');
  }

  #sourceFrame(frame: CloudFrame, nowMs: number, room: CaptureRoom): SourceFrame {
    const { form, points: count, pose, capturedAtMs } = frame;
    const isAhead = capturedAtMs !== null && capturedAtMs > nowMs + MOST_AHEAD_MS;
    if (isAhead) this.onFault?.(new Error('the producer says that a frame was captured in the future'));
    const takenMs = isAhead ? nowMs - REFUSED_AGE_MS : Math.min(capturedAtMs ?? this.#readyMs, nowMs);
    // The camera's poses are all that is known of the robot's motion.
    if (pose !== null && !isAhead) {
      const base = compose(pose, inverse(this.#mount));
      this.#state = { ...STANDING, pose: base, twist: null, measuredMs: takenMs };
    }
    const stamp = {
      cameraPose: pose ?? this.#mount,
      capturedAtMs: takenMs,
      ...(pose === null || isAhead ? { base: 'unknown' as const } : {}),
    };
    return form === 'images'
      ? { form, depth: room.depth, colour: room.colour, ...stamp }
      : { form, points: room.points, count, ...stamp };
  }
}

function roomFor(points: number): FrameRoom {
  return {
    points: new Float32Array(points * 4),
    depth: new Float32Array(points),
    colour: new Uint32Array(points),
  };
}
