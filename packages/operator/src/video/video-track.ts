/** Recognises the tracks of the robot's videos, and makes the browser play them without delay. */
import { MAX_VIDEOS, videoStreamId } from '@farpoint/protocol';

/** A camera's video as it is received. */
export interface VideoTrack {
  /** The video's number: its index in the list of the `videos` event. */
  video: number;
  /** Give it to a `<video>` element in a `MediaStream` of its own. */
  track: MediaStreamTrack;
  /** What receives it. With a `transform`, a page takes the encoded frames itself. */
  receiver: RTCRtpReceiver;
}

/** @returns the number of the video to which a stream with one of these ids belongs; `null` if it is no video */
export function videoOfStreams(ids: readonly string[]): number | null {
  for (let video = 0; video < MAX_VIDEOS; video++) if (ids.includes(videoStreamId(video))) return video;
  return null;
}

/**
 * Asks for no more delay than decoding needs. An operator who drives is better served by a picture that is late now and
 * then than by one that is always late. Browsers without either attribute ignore it.
 */
export function playWithoutDelay(receiver: RTCRtpReceiver): void {
  // The second is the older name, which some browsers have instead. TypeScript's types have the first only.
  Object.assign(receiver, { jitterBufferTarget: 0, playoutDelayHint: 0 });
}
