import type { Codec } from '@farpoint/wasm-codec';
import { BridgeStream } from '../bridge/bridge-stream.ts';
import { ReceivePipeline, type ReceivePipelinePort } from './pipeline.ts';
import type { ToCloudWorker } from './worker-messages.ts';

/** An RTP payload as an encoded transform delivers it (https://w3c.github.io/webrtc-encoded-transform/). */
export interface EncodedPayload {
  data: ArrayBuffer;
  getMetadata(): {
    sequenceNumber?: number;
    /** When the packet arrived, as `performance.now()`, in browsers that provide it. */
    receiveTime?: number;
  };
}

/** The cloud worker's work: decodes the receiver's payloads or a bridge's frames, those of the newest session only. */
export class CloudDecoding {
  readonly #pipeline: ReceivePipeline;
  /** `null` if the codec cannot be loaded; the page has been told. */
  readonly #codec: Promise<Codec | null>;
  #bridge: BridgeStream | null = null;

  constructor(loading: Promise<Codec>, port: ReceivePipelinePort) {
    this.#pipeline = new ReceivePipeline(port);
    this.#codec = loading.then(
      (codec) => {
        port.post({ type: 'ready' }, []);
        return codec;
      },
      (error: unknown) => {
        port.post({ type: 'failed', message: error instanceof Error ? error.message : String(error) }, []);
        return null;
      },
    );
  }

  onMessage(message: ToCloudWorker): void {
    switch (message.type) {
      case 'return':
        this.#pipeline.giveBack(message.buffer);
        return;
      case 'stream':
        void this.consume(message.readable, message.generation);
        return;
      case 'cloudStream':
        void this.#beginStream(message);
        return;
      case 'bridge':
        this.#takeFromBridge(message.url, message.generation);
        return;
      case 'drawEvery':
        this.#pipeline.drawEvery(message.every, message.everySample);
        return;
      case 'drawSurface':
        this.#pipeline.drawSurface(message.wanted);
    }
  }

  /** Decodes a session's payloads and forwards none, until the stream ends or a newer session begins. */
  async consume(stream: ReadableStream<EncodedPayload>, generation: number): Promise<void> {
    const codec = await this.#codec;
    const pipeline = this.#pipeline;
    if (codec === null || generation < pipeline.generation) return;
    pipeline.begin(generation, codec);
    const reader = stream.getReader();
    for (;;) {
      const { value: payload, done } = await reader.read().catch(() => ({ value: undefined, done: true }));
      if (done || payload === undefined || pipeline.generation !== generation) break;
      const { sequenceNumber, receiveTime = Number.NaN } = payload.getMetadata();
      pipeline.take(payload.data, sequenceNumber, receiveTime);
    }
    reader.cancel().catch(() => undefined);
  }

  /** Reports the session's totals. */
  report(): void {
    this.#pipeline.report();
  }

  async #beginStream(message: ToCloudWorker & { type: 'cloudStream' }): Promise<void> {
    const codec = await this.#codec;
    if (codec === null || message.generation < this.#pipeline.generation) return;
    this.#pipeline.begin(message.generation, codec);
    this.#pipeline.beginStream(codec, message.format, message.header, message.sensor);
  }

  #takeFromBridge(url: string, generation: number): void {
    const pipeline = this.#pipeline;
    this.#bridge ??= new BridgeStream(url, pipeline.pool, { flush: (batch) => pipeline.handOver(batch) });
    this.#bridge.restart();
    pipeline.beginCounting(generation, this.#bridge.intake);
  }
}
