/** Reads the frames of a video's track as the browser decodes them, each with its time. */

import type { OpenReader, ReadFrame } from './open-reader.ts';
import { rtpTimestampOf, takeImage } from './video-image.ts';

/** Chromium offers it to pages, other browsers to workers only. TypeScript's types lack it. */
declare const MediaStreamTrackProcessor:
  | (new (init: {
      track: MediaStreamTrack;
      maxBufferSize?: number;
    }) => { readonly readable: ReadableStream<VideoFrame> })
  | undefined;

/**
 * Pictures that wait for the page, at most; the oldest make room. Chosen: one is being taken, and one has
 * just come; more are delay (docs/cameras.md).
 */
const MOST_BUFFERED = 2;

/** Whether this browser gives a track's pictures one by one as it decodes them, without an element that plays it. */
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

/** Whether this browser tells when a video shows another frame. */
export function hasFrameCallbacks(): boolean {
  return 'requestVideoFrameCallback' in HTMLVideoElement.prototype;
}

export const openNative: OpenReader = ({ track }, { onFrame }) => new VideoReader(track, onFrame);

class VideoReader {
  /** Is not part of the page: its frames are drawn elsewhere, when their time has come. */
  readonly #video = document.createElement('video');
  readonly #onFrame: (frame: ReadFrame) => void;
  #callback = 0;
  #closed = false;

  constructor(track: MediaStreamTrack, onFrame: (frame: ReadFrame) => void) {
    this.#onFrame = onFrame;
    const video = this.#video;
    Object.assign(video, { muted: true, autoplay: true, playsInline: true });
    // In a stream of its own: a browser may delay tracks of one stream to play them in step, by rules of its own.
    video.srcObject = new MediaStream([track]);
    // Refused or interrupted: frames come all the same as soon as the browser plays.
    video.play().catch(() => undefined);
    this.#await();
  }

  close(): void {
    this.#closed = true;
    this.#video.cancelVideoFrameCallback(this.#callback);
    this.#video.srcObject = null;
  }

  #await(): void {
    this.#callback = this.#video.requestVideoFrameCallback((_, metadata) => {
      this.#read(metadata);
      if (!this.#closed) this.#await();
    });
  }

  #read({ rtpTimestamp, captureTime }: VideoFrameCallbackMetadata): void {
    takeImage(this.#video, (image) => {
      if (image === null) return;
      if (this.#closed) image.close();
      else {
        this.#onFrame({
          image,
          // The element may already show a newer picture than the one that the callback is about.
          rtpTimestamp: image.rtpTimestamp ?? rtpTimestamp ?? null,
          capturedAtMs: captureTime ?? null,
        });
      }
    });
  }
}
