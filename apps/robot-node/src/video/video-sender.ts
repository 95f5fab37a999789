import type { VideoFrame } from './video-frame.ts';

/** Why this operator did not get a frame of a video. */
export type VideoDropReason =
  | 'no-key-frame' // it cannot be decoded without an earlier one that was not sent
  | 'overdue'; // the path had no room for it in time

/** One operator's videos: which it wants, and from which frame on it can decode them. */
export class VideoSender {
  /** The videos that the operator wants. */
  wanted: ReadonlySet<number> = new Set();
  readonly drops: Record<VideoDropReason, number> = { 'no-key-frame': 0, overdue: 0 };
  readonly #lines: ReadonlySet<number>;
  readonly #enqueue: (frame: VideoFrame) => void;
  readonly #needsKeyFrame: (video: number) => void;
  /** Videos whose frames the operator can decode, because it got all since a key frame. */
  readonly #decodable = new Set<number>();

  /**
   * @param lines the videos that the operator accepted
   * @param enqueue takes a frame for the pacer
   * @param needsKeyFrame called whenever the operator can continue with a key frame only
   */
  constructor(
    lines: Iterable<number>,
    enqueue: (frame: VideoFrame) => void,
    needsKeyFrame: (video: number) => void,
  ) {
    this.#lines = new Set(lines);
    this.#enqueue = enqueue;
    this.#needsKeyFrame = needsKeyFrame;
  }

  want(videos: readonly number[]): void {
    const wanted = new Set(videos.filter((video) => this.#lines.has(video)));
    for (const video of this.#decodable) if (!wanted.has(video)) this.#decodable.delete(video);
    const added = [...wanted].filter((video) => !this.wanted.has(video));
    this.wanted = wanted;
    for (const video of added) this.#needsKeyFrame(video);
  }

  offer(frame: VideoFrame): void {
    const { video } = frame;
    if (!this.wanted.has(video)) return;
    if (frame.key) this.#decodable.add(video);
    else if (!this.#decodable.has(video)) {
      this.drops['no-key-frame']++;
      return;
    }
    this.#enqueue(frame);
  }

  /** The pacer dropped a frame: those that follow cannot be decoded. */
  onDropped(video: number): void {
    this.drops.overdue++;
    this.#lose(video);
  }

  /** The operator says that it has lost the picture (PLI, FIR). */
  onPictureLoss(video: number): void {
    if (this.wanted.has(video)) this.#needsKeyFrame(video);
  }

  /** The stream was stopped: what was queued is gone. */
  clear(): void {
    for (const video of [...this.#decodable]) this.#lose(video);
  }

  #lose(video: number): void {
    if (this.#decodable.delete(video) && this.wanted.has(video)) this.#needsKeyFrame(video);
  }
}
