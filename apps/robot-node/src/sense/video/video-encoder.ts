/** The interface between a camera's encoder, in a process of its own, and what the robot does with its pictures. */
import type { VideoCodec } from '@farpoint/protocol';
import type { VideoFailureReason } from '@farpoint/video';
import type { EncodedPicture } from './video-frame.ts';
import type { EncodedFormat, VideoFormat } from './video-plan.ts';

/** Why a camera's encoder, or the thread that feeds it, has ended. */
export type VideoFaultReason = VideoFailureReason | 'feed-ended' | 'feed-hung';

export interface VideoEncoderEvents {
  onPicture(picture: EncodedPicture): void;
  /**
   * @param fault why there are no pictures, for people; `null` when they come again
   * @param reason for programs, each time that something has ended
   */
  onFault(fault: string | null, reason?: VideoFaultReason): void;
}

export interface VideoEncoder {
  /** May be called at any time; what has changed takes effect within a few frames. */
  configure(format: EncodedFormat): void;
  /** The next picture that can be a key frame is one. */
  requestKeyFrame(): void;
  /** Pictures that came but were not encoded, because the encoder was too slow or they were damaged. */
  readonly dropped: number;
  close(): Promise<void>;
}

/** A camera that is streamed as video. */
export interface VideoCamera {
  /** For people. */
  name: string;
  /** What it can be encoded with, in the order of preference; at least one. */
  codecs: readonly VideoCodec[];
  /** What it is configured for; a slow link gets less. */
  most: VideoFormat;
  /** Number of the sensor whose own colour picture it is. */
  ofSensor?: number | undefined;
  /**
   * Starts the camera and its encoder. Never throws: faults are events.
   *
   * @param codec one of its codecs
   */
  open(codec: VideoCodec, format: EncodedFormat, events: VideoEncoderEvents): VideoEncoder;
}

/** What a camera's encoder says for the log. The log itself, or a thread's way to it. */
export interface VideoLog {
  debug(fields: object, message: string): void;
  info(fields: object, message: string): void;
  warn(fields: object, message: string): void;
  error(fields: object, message: string): void;
}
