/** Reads a video's track picture by picture as the browser decodes it, without an element that plays it. */

import type { OpenReader } from './open-reader.ts';
import { rtpTimestampOf } from './video-image.ts';

/** Chromium offers it to pages, other browsers to workers only. TypeScript's types lack it. */
declare const MediaStreamTrackProcessor:
  | (new (init: {
      track: MediaStreamTrack;
      maxBufferSize?: number;
    }) => { readonly readable: ReadableStream<VideoFrame> })
  | undefined;

/** Pictures that wait for the page, at most; the oldest make room. */
const MOST_BUFFERED = 2;

export function hasTrackProcessor(): boolean {
  return typeof MediaStreamTrackProcessor !== 'undefined';
}

export const openTrack: OpenReader = ({ track }, { onFrame }) => {
  if (MediaStreamTrackProcessor === undefined)
    throw new Error('this browser has no MediaStreamTrackProcessor');
  const { readable } = new MediaStreamTrackProcessor({ track, maxBufferSize: MOST_BUFFERED });
  const reader = readable.getReader();
  const read = async (): Promise<void> => {
    for (;;) {
      const { done, value: frame } = await reader.read();
      if (done) return;
      const { displayWidth: width, displayHeight: height } = frame;
      const rtpTimestamp = rtpTimestampOf(frame);
      const image = { image: frame, width, height, rtpTimestamp, close: () => frame.close() };
      onFrame({ image, rtpTimestamp, capturedAtMs: null });
    }
  };
  // The stream ends with the track or with `cancel`.
  read().catch(() => undefined);
  return { close: () => void reader.cancel().catch(() => undefined) };
};
