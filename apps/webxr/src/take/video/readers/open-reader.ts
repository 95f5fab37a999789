/** The interface between a way to receive videos and what presents their frames. */
import type { VideoCodec } from '@farpoint/operator';
import type { VideoImage } from './video-image.ts';

/** Where a video's frames come from. */
export interface VideoSource {
  readonly track: MediaStreamTrack;
  readonly receiver: RTCRtpReceiver;
  /** What it has at first. */
  readonly codec: VideoCodec;
}

/** A frame, and what is known about when it was captured. */
export interface ReadFrame {
  readonly image: VideoImage;
  /** `null` where the browser does not tell. */
  readonly rtpTimestamp: number | null;
  /** When it was captured, on the page's clock as the browser estimates it; `null` where the browser does not tell. */
  readonly capturedAtMs: number | null;
}

export interface ReaderEvents {
  /** Whoever takes the frame closes its image. */
  onFrame(frame: ReadFrame): void;
  /** This browser cannot decode the video; nothing follows. */
  onUnsupported(detail: string): void;
}

export interface Reader {
  close(): void;
  /** The video has another codec from some frame on; absent where the browser sees to that by itself. */
  useCodec?(codec: VideoCodec): void;
  /** Frames that arrived and were not decoded so far, where that can be known. */
  readonly undecoded?: Readonly<Record<string, number>>;
}

/** Begins to read a video. */
export type OpenReader = (source: VideoSource, events: ReaderEvents) => Reader;
