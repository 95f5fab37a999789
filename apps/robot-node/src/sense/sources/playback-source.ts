import type {
  BaseState,
  FrameSource,
  ImageFrame,
  PointFrame,
  SourceDescription,
  SourceFrame,
} from '@farpoint/cloud-source';
import { OPTICAL_IN_BODY, type Pose, zeroTwist } from '@farpoint/protocol';

/** A decoded cloud: points or images, as the source's description says. */
export type RecordedCloud =
  | Pick<PointFrame, 'form' | 'points' | 'count'>
  | Pick<ImageFrame, 'form' | 'depth' | 'colour'>;

/** A recorded cloud, decoded on demand. */
export interface RecordedFrame {
  /** The name of its file, for errors. */
  name: string;
  /** @throws {Error} if it cannot be read */
  load(): RecordedCloud;
  cameraPose: Pose;
}

/**
 * Bytes of decoded frames to keep. Frames beyond this are decoded each time. Chosen: short loops are decoded
 * once, and a computer with 2 GB still has room.
 */
const CACHE_BYTES = 512 * 1024 * 1024;

/** Pose of a camera without poses: 1 m above the world's origin, looking along +x. */
export const STATIC_CAMERA_POSE: Pose = {
  position: { x: 0, y: 0, z: 1 },
  orientation: OPTICAL_IN_BODY,
};

/** The state of a source that has no wheels and no pose. */
export const STANDING: BaseState = {
  pose: { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
  twist: zeroTwist(),
  battery: null,
  contact: false,
};

/** Plays recorded clouds in a loop, one per capture. It has no wheels. */
export class PlaybackSource implements FrameSource {
  readonly description: SourceDescription;
  readonly state = STANDING;
  readonly #frames: readonly RecordedFrame[];
  readonly #cache = new Map<number, RecordedCloud>();
  #cachedBytes = 0;
  #next = 0;

  /** @throws {Error} if there is no frame, or if a cached frame cannot be read: at start, not in mid-stream */
  constructor(description: SourceDescription, frames: readonly RecordedFrame[]) {
    if (frames.length === 0) throw new Error(`${description.kind}: no frames`);
    this.description = description;
    this.#frames = frames;
    for (let i = 0; i < frames.length && this.#cachedBytes < CACHE_BYTES; i++) this.#cloud(i);
  }

  capture(nowMs: number): SourceFrame {
    const index = this.#next;
    this.#next = (index + 1) % this.#frames.length;
    const { cameraPose } = this.#frames[index] as RecordedFrame;
    return { ...this.#cloud(index), cameraPose, capturedAtMs: nowMs };
  }

  close(): void {
    this.#cache.clear();
  }

  #cloud(index: number): RecordedCloud {
    const cached = this.#cache.get(index);
    if (cached !== undefined) return cached;
    const frame = this.#frames[index] as RecordedFrame;
    let cloud: RecordedCloud;
    try {
      cloud = frame.load();
    } catch (error) {
      throw new Error(`${frame.name}: ${error instanceof Error ? error.message : String(error)}`, {
        cause: error,
      });
    }
    const count = cloud.form === 'points' ? cloud.count : cloud.depth.length;
    if (count > this.description.capacity) {
      throw new Error(`${frame.name}: ${count} points, ${this.description.capacity} expected`);
    }
    const bytes = count * (cloud.form === 'points' ? 16 : 8);
    if (this.#cachedBytes + bytes <= CACHE_BYTES) {
      this.#cache.set(index, cloud);
      this.#cachedBytes += bytes;
    }
    return cloud;
  }
}
