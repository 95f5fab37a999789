/** How this browser receives videos: as `?video=` says, or else in the fastest way that it has. */

import { VIDEO_RECEIVERS, type VideoReceiverName } from '../../ground/settings.ts';
import type { OpenReader } from './readers/open-reader.ts';
import { hasFrameCallbacks, hasTrackProcessor, openNative, openTrack } from './readers/video-reader.ts';
import { hasWebCodecs, WebCodecsReceiver } from './webcodecs/webcodecs-receiver.ts';

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
