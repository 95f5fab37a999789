import type { VideoCodec } from '@farpoint/protocol';
import type { VideoFrame } from '../../sense/video/video-frame.ts';

/** Why this operator did not get a frame of a video. */
export type VideoDropReason =
  | 'other-codec' // the operator does not decode what it is coded with
  | 'no-key-frame' // it cannot be decoded without an earlier one that was not sent
  | 'overdue'; // the path had no room for it in time

/** One operator's videos: which it wants, and from which frame on it can decode them. */
export class VideoSender {
  /** The videos that the operator wants. */
  wanted: ReadonlySet<number> = new Set();
  readonly drops: Record<VideoDropReason, number> = {
    'other-codec': 0,
    'no-key-frame': 0,
    overdue: 0,
  };
  readonly #codecs: ReadonlyMap<number, ReadonlySet<VideoCodec>>;
  readonly #enqueue: (frame: VideoFrame) => void;
  readonly #needsKeyFrame: (video: number) => void;
  /** Videos whose frames the operator can decode, because it got all since a key frame, and the codec of that. */
  readonly #decodable = new Map<number, VideoCodec>();

  /**
   * @param codecs of the videos that the operator accepted, by number
   * @param enqueue takes a frame for the pacer
   * @param needsKeyFrame called whenever the operator can continue with a key frame only
   */
  constructor(
    codecs: ReadonlyMap<number, ReadonlySet<VideoCodec>>,
    enqueue: (frame: VideoFrame) => void,
    needsKeyFrame: (video: number) => void,
  ) {
    this.#codecs = codecs;
    this.#enqueue = enqueue;
    this.#needsKeyFrame = needsKeyFrame;
  }

  want(videos: readonly number[]): void {
    const wanted = new Set(videos.filter((video) => this.#codecs.has(video)));
    for (const video of this.#decodable.keys()) if (!wanted.has(video)) this.#decodable.delete(video);
    const added = [...wanted].filter((video) => !this.wanted.has(video));
    this.wanted = wanted;
    for (const video of added) this.#needsKeyFrame(video);
  }

  offer(frame: VideoFrame): void {
    const { video, codec } = frame;
    if (!this.wanted.has(video)) return;
    if (this.#codecs.get(video)?.has(codec) !== true) {
      this.#decodable.delete(video);
      this.drops['other-codec']++;
      return;
    }
    if (frame.key) this.#decodable.set(video, codec);
    else if (this.#decodable.get(video) !== codec) {
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
    for (const video of [...this.#decodable.keys()]) this.#lose(video);
  }

  #lose(video: number): void {
    if (this.#decodable.delete(video) && this.wanted.has(video)) this.#needsKeyFrame(video);
  }
}
