/** A camera that a thread feeds, and what comes from it. */
import { availableEncoders, VIDEO_ENCODERS } from '@farpoint/video';
import type { FeedSource } from '../sense/video/feed/feed-source.ts';
import type { FeedThread } from '../sense/video/feed/feed-thread.ts';
import type { VideoEncoder, VideoFaultReason } from '../sense/video/video-encoder.ts';
import type { EncodedPicture } from '../sense/video/video-frame.ts';

export const hasVideo = await availableEncoders().then(
  () => true,
  () => false,
);
const FORMAT = {
  ...{ width: 640, height: 480, framesPerSecond: 30, bitsPerSecond: 1_000_000 },
  barcode: false,
};
const vp8 = VIDEO_ENCODERS.find(({ name }) => name === 'vp8enc')!;
export class WatchedCamera {
  readonly pictures: EncodedPicture[] = [];
  readonly faults: (string | null)[] = [];
  /** Of what has ended. */
  readonly reasons: VideoFaultReason[] = [];
  readonly encoder: VideoEncoder;
  #waiting: (() => void)[] = [];

  constructor(thread: FeedThread, name: string, source: FeedSource) {
    this.encoder = thread.open({ name, source, encoder: vp8 }, FORMAT, {
      onPicture: (picture) => this.#tell(() => this.pictures.push(picture)),
      onFault: (fault, reason) =>
        this.#tell(() => {
          this.faults.push(fault);
          if (reason !== undefined) this.reasons.push(reason);
        }),
    });
  }

  /** Resolves once `is` returns true; it is asked again whenever something has come. */
  async until(is: () => boolean): Promise<void> {
    while (!is()) await new Promise<void>((resolve) => this.#waiting.push(resolve));
  }

  #tell(change: () => void): void {
    change();
    for (const each of this.#waiting.splice(0)) each();
  }
}
