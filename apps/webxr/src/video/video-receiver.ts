/** How this browser receives videos: `?video=native` or `?video=webcodecs`, or else what suits it best. */
import type { VideoCodec } from '@farpoint/operator';
import { hasTrackProcessor, openTrack } from './track-reader.ts';
import type { VideoImage } from './video-image.ts';
import { hasFrameCallbacks, openNative } from './video-reader.ts';
import { VIDEO_RECEIVERS, type VideoReceiverName } from './video-receiver-name.ts';
import { hasWebCodecs, WebCodecsReceiver } from './webcodecs/webcodecs-receiver.ts';

/** Where a video's frames come from. */
export interface VideoSource {
  readonly track: MediaStreamTrack;
  readonly receiver: RTCRtpReceiver;
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
  /** Frames that arrived and were not decoded so far, where that can be known. */
  readonly undecoded?: Readonly<Record<string, number>>;
}

/** Begins to read a video. */
export type OpenReader = (source: VideoSource, events: ReaderEvents) => Reader;

export interface VideoReceiver {
  readonly name: VideoReceiverName;
  readonly open: OpenReader;
  /** Is to be told of each receiver as soon as there is one. */
  readonly adopt?: (receiver: RTCRtpReceiver) => void;
}

/** @returns `null` if this browser cannot read videos */
export function videoReceiver(asked: VideoReceiverName | null): VideoReceiver | null {
  const name = receiverFor(asked, {
    track: hasTrackProcessor(),
    native: hasFrameCallbacks(),
    webcodecs: hasWebCodecs(),
  });
  if (name === null) return null;
  if (name === 'webcodecs') {
    const { open, adopt } = new WebCodecsReceiver();
    return { name, open, adopt };
  }
  return { name, open: name === 'track' ? openTrack : openNative };
}

/** @param has what this browser can do */
export function receiverFor(
  asked: VideoReceiverName | null,
  has: Readonly<Record<VideoReceiverName, boolean>>,
): VideoReceiverName | null {
  const order = asked === null ? VIDEO_RECEIVERS : [asked, ...VIDEO_RECEIVERS];
  return order.find((name) => has[name]) ?? null;
}
