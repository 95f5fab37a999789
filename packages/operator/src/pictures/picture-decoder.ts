/** Decodes cameras' pictures in a worker, the newest of each camera. */
import type { WholePicture } from '@farpoint/protocol';
import { DecodeQueue, type FromPictureWorker, type PictureToDecode } from './decode-queue.ts';

export interface PictureDecoderEvents {
  /** Whoever takes the bitmap closes it. */
  onPicture(picture: WholePicture, receivedAtMs: number, bitmap: ImageBitmap): void;
  /** A picture could not be decoded. */
  onFault(picture: WholePicture, detail: string): void;
}

export class PictureDecoder {
  readonly #events: PictureDecoderEvents;
  readonly #queue: DecodeQueue;
  readonly #receivedAtMs = new WeakMap<WholePicture, number>();
  #worker: Worker | null = null;

  constructor(events: PictureDecoderEvents) {
    this.#events = events;
    this.#queue = new DecodeQueue((picture) => this.#decode(picture));
  }

  add(picture: WholePicture, nowMs: number): void {
    this.#receivedAtMs.set(picture, nowMs);
    this.#queue.add(picture);
  }

  /** The robot has changed: forgets the pictures that are being decoded or waiting. */
  clear(): void {
    this.#queue.clear();
  }

  close(): void {
    this.clear();
    this.#worker?.terminate();
    this.#worker = null;
  }

  #decode(picture: PictureToDecode): void {
    if (this.#worker === null) {
      const worker = new Worker(new URL('./picture-worker.ts', import.meta.url), { type: 'module' });
      worker.onmessage = ({ data }: MessageEvent<FromPictureWorker>) => this.#onDecoded(data);
      worker.onerror = (event) => {
        console.warn('picture worker:', event.message);
        // The next picture starts a new worker.
        worker.terminate();
        this.#worker = null;
        this.#queue.clear();
      };
      this.#worker = worker;
    }
    this.#worker.postMessage(picture);
  }

  #onDecoded(message: FromPictureWorker): void {
    const picture = this.#queue.ended(message.ticket);
    if (picture === null) {
      if ('bitmap' in message) message.bitmap.close();
    } else if ('fault' in message) {
      this.#events.onFault(picture, message.fault);
    } else {
      this.#events.onPicture(picture, this.#receivedAtMs.get(picture) ?? performance.now(), message.bitmap);
    }
  }
}
