/** The pictures of the cameras that are watched, decoded, each with the time at which it was taken. */
import type { WholePicture } from '@farpoint/protocol';
import type { AgeOfStamp } from '../latency/frame-latency.ts';
import { PictureDecoder } from './picture-decoder.ts';

/** A camera's picture, decoded. */
export interface Picture {
  /** Index in the list of the `cameras` event. */
  camera: number;
  /** Close it when it has been drawn. */
  bitmap: ImageBitmap;
  /** When it was taken, as `performance.now()` of this page; when it was received, until the robot's clock is known. */
  takenAtMs: number;
}

export interface PictureFeedEvents {
  /** @returns whether anybody takes it, and closes the bitmap */
  onPicture(picture: Picture): boolean;
  /** A file that cannot be decoded. */
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

  /** Pictures of these cameras are decoded, and of no others. */
  watch(cameras: readonly number[]): void {
    this.#watched = [...cameras];
  }

  /** The robot has other cameras, or another robot has. */
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
