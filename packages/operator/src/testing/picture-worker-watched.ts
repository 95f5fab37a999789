/** A real picture worker of which a test knows when it has answered: browsers decode pictures in their own time. */
import type { FromPictureWorker, PictureToDecode } from '../pictures/decode-queue.ts';

/** The parts of a `Worker` that the library uses, and {@link decoded}. */
export class PictureWorkerWatched {
  onmessage: ((event: { data: FromPictureWorker }) => void) | null = null;
  onerror: ((event: { message: string }) => void) | null = null;
  readonly #worker: Worker;
  #open = 0;
  readonly #told: (() => void)[] = [];

  constructor(worker: Worker) {
    this.#worker = worker;
    worker.onmessage = ({ data }: MessageEvent<FromPictureWorker>) => {
      this.onmessage?.({ data });
      this.#end(1);
    };
    worker.onerror = (event) => {
      this.onerror?.(event);
      this.#end(this.#open);
    };
  }

  postMessage(picture: PictureToDecode): void {
    this.#open++;
    this.#worker.postMessage(picture);
  }

  /** Resolves once each picture that was posted has been handed on, or has been found to be broken. */
  decoded(): Promise<void> {
    return this.#open === 0 ? Promise.resolve() : new Promise((resolve) => this.#told.push(resolve));
  }

  terminate(): void {
    this.#worker.terminate();
  }

  #end(answered: number): void {
    this.#open -= answered;
    if (this.#open === 0) for (const tell of this.#told.splice(0)) tell();
  }
}
