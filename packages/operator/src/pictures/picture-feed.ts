/** Decoded pictures of the watched cameras, each with the time at which it was taken. */
import type { WholePicture } from '@farpoint/protocol';
import type { AgeOfStamp } from '../latency/frame-latency.ts';
import { PictureDecoder } from './picture-decoder.ts';

/** A camera's picture, decoded. */
export interface Picture {
  /** Index in the list of the `cameras` event. */
  camera: number;
  /** Close it when it has been drawn. */
  bitmap: ImageBitmap;
  /** When it was taken, in this page's `performance.now()`; until the robot's clock is known, when it was received. */
  takenAtMs: number;
}

export interface PictureFeedEvents {
  /** @returns whether a listener takes it and will close the bitmap */
  onPicture(picture: Picture): boolean;
  /** A picture could not be decoded. */
  onFault(camera: number, detail: string): void;
}

export class PictureFeed {
  readonly #decoder: PictureDecoder;
  #watched: readonly number[] = [];

  constructor(ageOf: AgeOfStamp, events: PictureFeedEvents) {
    this.#decoder = new PictureDecoder({
      onPicture: ({ camera, captureTimeUs }, receivedAtMs, bitmap) => {
        const takenAtMs = receivedAtMs - (ageOf(captureTimeUs, receivedAtMs) ?? 0);
        if (!events.onPicture({ camera, bitmap, takenAtMs })) bitmap.close();
      },
      onFault: ({ camera }, detail) => events.onFault(camera, detail),
    });
  }

  /** Decodes the pictures of these cameras only. */
  watch(cameras: readonly number[]): void {
    this.#watched = [...cameras];
  }

  /** The list of cameras has changed, perhaps because the robot has. */
  reset(): void {
    this.#decoder.clear();
    this.#watched = [];
  }

  add(picture: WholePicture, nowMs: number): void {
    if (this.#watched.includes(picture.camera)) this.#decoder.add(picture, nowMs);
  }

  close(): void {
    this.#decoder.close();
  }
}
