/** A video without a key frame for this long is slow to jump into, ms: one is asked for. */
const KEY_FRAME_MS = 4000;
/** A key frame that was asked for and has not come is asked for again after this long, ms. */
const ASK_AGAIN_MS = 1000;

/** One coded picture of a camera, on its way to a recording. */
export interface QueuedVideoFrame {
  /** Position in the list of videos. */
  video: number;
  /** Whether it can be decoded without any other. */
  key: boolean;
  /** On the robot's clock, ms. */
  capturedAtMs: number;
  bytes: Uint8Array;
}

export interface VideoQueueLimits {
  /** Frames that the receiver may hold. */
  underWay: number;
  /** Frames of all videos that may wait, and their bytes. */
  waiting: number;
  waitingBytes: number;
}

interface Track {
  /** Whether every frame since a key frame was taken, so that the next one can be decoded. */
  whole: boolean;
  keyMs: number;
  askedMs: number;
}

/**
 * A bounded queue of coded pictures in front of something slow. What leaves it can be decoded: each video begins with a
 * key frame, and if too much waits, the oldest frame is dropped together with those that build on it.
 */
export class VideoQueue<T extends QueuedVideoFrame> {
  /** Frames that were not passed on: too much waited, or a frame that they build on is missing. */
  dropped = 0;
  /** Called when a video can go on with a key frame only, or has had none for long. */
  onKeyFrameNeeded: ((video: number) => void) | null = null;
  readonly #limits: VideoQueueLimits;
  readonly #post: (frame: T) => void;
  readonly #tracks = new Map<number, Track>();
  #waiting: T[] = [];
  #waitingBytes = 0;
  #credits: number;

  constructor(limits: VideoQueueLimits, post: (frame: T) => void) {
    this.#limits = limits;
    this.#credits = limits.underWay;
    this.#post = post;
  }

  /** @returns whether the frame was taken */
  push(frame: T): boolean {
    const track = this.#trackOf(frame.video);
    if (frame.key) {
      track.whole = true;
      track.keyMs = frame.capturedAtMs;
    } else {
      const needed = !track.whole || frame.capturedAtMs - track.keyMs >= KEY_FRAME_MS;
      if (needed) this.#ask(frame, track);
      if (!track.whole) {
        this.dropped++;
        return false;
      }
    }
    if (this.#credits > 0) {
      this.#credits--;
      this.#post(frame);
      return true;
    }
    this.#waiting.push(frame);
    this.#waitingBytes += frame.bytes.length;
    const { waiting, waitingBytes } = this.#limits;
    while (this.#waiting.length > waiting || this.#waitingBytes > waitingBytes) this.#dropOldest();
    return track.whole;
  }

  /** A frame of this video was not offered: it goes on with a key frame. */
  skip(video: number): void {
    this.#trackOf(video).whole = false;
  }

  /** Call when the receiver has finished a frame. */
  done(): void {
    const next = this.#waiting.shift();
    if (next === undefined) {
      this.#credits++;
      return;
    }
    this.#waitingBytes -= next.bytes.length;
    this.#post(next);
  }

  /** Passes on everything that waits, at the end. */
  drain(): void {
    for (const frame of this.#waiting.splice(0)) this.#post(frame);
    this.#waitingBytes = 0;
  }

  /** Drops the oldest frame and those of the same video up to its next key frame. */
  #dropOldest(): void {
    const video = this.#waiting[0]?.video;
    let first = true;
    let dropping = true;
    const kept: T[] = [];
    for (const frame of this.#waiting) {
      if (frame.video === video && frame.key && !first) dropping = false;
      if (frame.video === video && dropping) {
        this.dropped++;
        this.#waitingBytes -= frame.bytes.length;
        first = false;
      } else kept.push(frame);
    }
    this.#waiting = kept;
    if (dropping && video !== undefined) this.#trackOf(video).whole = false;
  }

  #ask({ video, capturedAtMs }: T, track: Track): void {
    if (capturedAtMs - track.askedMs < ASK_AGAIN_MS) return;
    track.askedMs = capturedAtMs;
    this.onKeyFrameNeeded?.(video);
  }

  #trackOf(video: number): Track {
    let track = this.#tracks.get(video);
    if (track === undefined) {
      track = { whole: false, keyMs: 0, askedMs: Number.NEGATIVE_INFINITY };
      this.#tracks.set(video, track);
    }
    return track;
  }
}
