/** A robot's clouds without a robot and a worker: takes RTP payloads, and hands on batches as the cloud worker does. */
import type { CloudFormat } from '@farpoint/protocol';
import type { Codec } from '@farpoint/wasm-codec';
import type { RobotEvents } from '../client/robot-events.ts';
import { Batch } from '../cloud/batch.ts';
import { ReceivePipeline } from '../cloud/pipeline.ts';

export class AssembledCloud {
  readonly latency = { wantsTime: false };
  pointsAtMs = Number.NEGATIVE_INFINITY;
  readonly #codec: Codec;
  readonly #pipeline: ReceivePipeline;
  readonly #listeners: ((batch: Batch) => void)[] = [];
  #sequence = 0;
  #flush: (() => void) | null = null;

  constructor(codec: Codec) {
    this.#codec = codec;
    this.#pipeline = new ReceivePipeline({
      post: (message) => {
        if (message.type !== 'batch') return;
        const batch = new Batch(message.buffer, message.packets, message.points, message.sensor);
        for (const listener of this.#listeners) listener(batch);
      },
      nowMs: () => performance.now(),
      timeOriginMs: performance.timeOrigin,
      setTimer: (act) => {
        this.#flush = act;
        return 1;
      },
      clearTimer: () => {
        this.#flush = null;
      },
    });
    this.#pipeline.begin(1, codec);
  }

  /** Begins a coded stream. */
  beginStream(format: Exclude<CloudFormat, 'points64'>, header: Uint8Array): void {
    this.#pipeline.beginStream(this.#codec, format, header);
  }

  /** As of `RobotClient`. */
  drawSurface(wanted: boolean): void {
    this.#pipeline.drawSurface(wanted);
  }

  /** Takes packets, and hands on everything that they hold. */
  take(payloads: readonly ArrayBuffer[]): void {
    for (const payload of payloads) this.#pipeline.take(payload, this.#sequence++ & 0xffff, Number.NaN);
    const flush = this.#flush;
    this.#flush = null;
    flush?.();
    this.pointsAtMs = performance.now();
  }

  on<Type extends keyof RobotEvents>(type: Type, listener: (event: RobotEvents[Type]) => void): () => void {
    // The types cannot say that these events are batches; no other event happens.
    if (type === 'cloud') this.#listeners.push(listener as (batch: Batch) => void);
    return () => undefined;
  }

  release({ buffer }: Batch): void {
    this.#pipeline.giveBack(buffer);
  }

  noteUploaded(): void {}
  noteDrawn(): void {}
}
