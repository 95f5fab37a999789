import type { VideoCodec } from '@farpoint/protocol';
import type { EncodedPicture } from './video-frame.ts';

/** Takes videos as they are encoded for operators, for example to record them. */
export interface VideoTaker {
  /** Whether a video is to be encoded although no operator can watch it. */
  wants(video: number): boolean;
  /** @param codec of the picture: it may change from key frame to key frame */
  take(video: number, picture: EncodedPicture, codec: VideoCodec): void;
}
