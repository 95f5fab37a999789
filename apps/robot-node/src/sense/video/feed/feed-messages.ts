/** Messages between the main thread and the thread that feeds cameras. Raw pictures are in none of them. */
import type { VideoEncoder } from '@farpoint/video';
import type { VideoFaultReason, VideoLog } from '../video-encoder.ts';
import type { EncodedPicture } from '../video-frame.ts';
import type { EncodedFormat } from '../video-plan.ts';
import type { FeedSource } from './feed-source.ts';

/** One opening of a camera, from when somebody watches until nobody does. */
export type RunId = number;

export type FeedRequest =
  | {
      type: 'open';
      run: RunId;
      /** For people. */
      name: string;
      source: FeedSource;
      encoder: VideoEncoder;
      format: EncodedFormat;
    }
  | { type: 'configure'; run: RunId; format: EncodedFormat }
  | { type: 'key-frame'; run: RunId }
  | { type: 'close'; run: RunId }
  /** Nothing is open any more: the thread ends by itself. */
  | { type: 'end' };

export type FeedReport =
  /** The bytes are transferred. */
  | { type: 'picture'; run: RunId; picture: EncodedPicture & { bytes: Uint8Array<ArrayBuffer> } }
  /** `reason` if its process has ended. */
  | { type: 'fault'; run: RunId; fault: string | null; reason?: VideoFaultReason | undefined }
  /** The thread lives. */
  | { type: 'alive' }
  /** Pictures that were captured but not encoded, since the run began in this thread. */
  | { type: 'dropped'; run: RunId; dropped: number }
  | { type: 'closed'; run: RunId }
  | { type: 'log'; run: RunId; level: keyof VideoLog; fields: object; message: string };
