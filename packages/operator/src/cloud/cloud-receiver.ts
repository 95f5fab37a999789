/** Owns the cloud worker: tells it what to decode, and takes its batches of points. */
import type { CloudFormat, CloudStream } from '@farpoint/protocol';
import { Batch } from './batch.ts';
import type { FromCloudWorker, IntakeReport, ToCloudWorker } from './worker-messages.ts';

export interface CloudReceiverEvents {
  /** Points were received. The listener must return the batch with {@link CloudReceiver.release}. */
  onBatch(batch: Batch): void;
  /** Totals of the session, ten times a second while packets arrive. */
  onReport(report: IntakeReport): void;
  /** A coded stream that this browser cannot decode. */
  onStreamRefused(format: CloudFormat, detail: string): void;
  /** The worker, or its WebAssembly module, cannot be loaded. */
  onFailed(detail: string): void;
}

export class CloudReceiver {
  /** The receiver's encoded frames go here. */
  readonly worker: Worker;
  readonly #events: CloudReceiverEvents;
  #generation = 0;

  constructor(events: CloudReceiverEvents) {
    this.#events = events;
    this.worker = new Worker(new URL('./cloud-worker.ts', import.meta.url), { type: 'module' });
    this.worker.onmessage = ({ data }: MessageEvent<FromCloudWorker>) => this.#onMessage(data);
    this.worker.onerror = ({ message }) => events.onFailed(message);
  }

  /** A session begins. Batches and reports of an earlier one are dropped from now on. */
  begin(generation: number): void {
    this.#generation = generation;
  }

  /** Sets the header with which a format's packets are decoded from now on. */
  beginStream({ format, header, sensor = 0 }: Omit<CloudStream, 'type'>): void {
    const bytes = Uint8Array.from(atob(header), (character) => character.charCodeAt(0));
    const generation = this.#generation;
    this.#post({ type: 'cloudStream', generation, sensor, format, header: bytes }, [bytes.buffer]);
  }

  /** Returns a batch to the worker, which has a limited number of them. Its buffer is detached afterwards. */
  release({ buffer }: Batch): void {
    this.#post({ type: 'return', buffer }, [buffer]);
  }

  /** Draws only one of every N points: one N for coded clouds, and one for `points64`, which is already a sample. */
  drawEvery(every: number, everySample: number): void {
    this.#post({ type: 'drawEvery', every, everySample }, []);
  }

  /** Whether clouds on a camera's grid come as tiles of a surface, from their next frame on, or as points. */
  drawSurface(wanted: boolean): void {
    this.#post({ type: 'drawSurface', wanted }, []);
  }

  close(): void {
    this.worker.terminate();
  }

  #post(message: ToCloudWorker, transfer: Transferable[]): void {
    this.worker.postMessage(message, transfer);
  }

  #onMessage(message: FromCloudWorker): void {
    switch (message.type) {
      case 'batch': {
        const batch = new Batch(message.buffer, message.packets, message.points, message.sensor);
        if (message.generation === this.#generation) this.#events.onBatch(batch);
        else this.release(batch);
        return;
      }
      case 'report':
        if (message.generation === this.#generation) this.#events.onReport(message);
        return;
      case 'streamRefused':
        if (message.generation === this.#generation)
          this.#events.onStreamRefused(message.format, message.message);
        return;
      case 'failed':
        this.#events.onFailed(message.message);
        return;
      case 'ready':
    }
  }
}
