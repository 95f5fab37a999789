/** Stands in for the cloud worker: decodes at once, on the caller's thread, so that a test knows when points are there. */
import { type Codec, loadCodec } from '@farpoint/wasm-codec';
import { ReceivePipeline } from '../cloud/pipeline.ts';
import type { FromCloudWorker, ToCloudWorker } from '../cloud/worker-messages.ts';

const REPORT_EVERY_MS = 100;

/** The parts of a `Worker` that the library uses, and {@link take} for the payloads of RTP packets. */
export class CloudWorkerHere {
  onmessage: ((event: { data: FromCloudWorker }) => void) | null = null;
  onerror: ((event: { message: string }) => void) | null = null;
  readonly #codec: Codec;
  readonly #pipeline: ReceivePipeline;
  readonly #timer: ReturnType<typeof setInterval>;

  private constructor(codec: Codec) {
    this.#codec = codec;
    this.#pipeline = new ReceivePipeline({
      // A copy, as between threads: who keeps a buffer that it has handed over finds it detached.
      post: (message, transfer) => this.onmessage?.({ data: structuredClone(message, { transfer }) }),
      nowMs: () => performance.now(),
      timeOriginMs: performance.timeOrigin,
      setTimer: (act, afterMs) => setTimeout(act, afterMs) as unknown as number,
      clearTimer: (timer) => clearTimeout(timer),
    });
    this.#timer = setInterval(() => this.#pipeline.report(), REPORT_EVERY_MS);
  }

  static async open(): Promise<CloudWorkerHere> {
    return new CloudWorkerHere(await loadCodec());
  }

  postMessage(message: ToCloudWorker, transfer: Transferable[] = []): void {
    const told = structuredClone(message, { transfer });
    switch (told.type) {
      case 'return':
        this.#pipeline.giveBack(told.buffer);
        return;
      case 'cloudStream':
        this.begin(told.generation);
        this.#pipeline.beginStream(this.#codec, told.format, told.header, told.sensor);
        return;
      case 'drawEvery':
        this.#pipeline.drawEvery(told.every, told.everySample);
        return;
      case 'drawSurface':
        this.#pipeline.drawSurface(told.wanted);
        return;
      case 'stream':
      case 'bridge':
        throw new Error(`a stand-in of the cloud worker takes no ${told.type}`);
    }
  }

  /** A session begins. @param generation its number, from 1 on */
  begin(generation: number): void {
    this.#pipeline.begin(generation, this.#codec);
  }

  /**
   * Takes the payload of one RTP packet, and keeps it.
   *
   * @param sequence the packet's number; a number that never comes is a lost packet
   */
  take(payload: ArrayBuffer, sequence: number): void {
    this.#pipeline.take(payload, sequence & 0xffff, performance.now());
  }

  terminate(): void {
    clearInterval(this.#timer);
  }
}
