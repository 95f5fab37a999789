import type { Codec } from '@farpoint/wasm-codec';
import { BridgeStream } from '../bridge/bridge-stream.ts';
import { BatchAssembler, type BatchAssemblerPort } from './batch-assembler.ts';
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
  readonly #assembler: BatchAssembler;
  /** `null` if the codec cannot be loaded; the page has been told. */
  readonly #codec: Promise<Codec | null>;
  #bridge: BridgeStream | null = null;

  constructor(loading: Promise<Codec>, port: BatchAssemblerPort) {
    this.#assembler = new BatchAssembler(port);
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
        this.#assembler.giveBack(message.buffer);
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
        this.#assembler.drawEvery(message.every, message.everySample);
        return;
      case 'drawSurface':
        this.#assembler.drawSurface(message.wanted);
    }
  }

  /** Decodes a session's payloads and forwards none, until the stream ends or a newer session begins. */
  async consume(stream: ReadableStream<EncodedPayload>, generation: number): Promise<void> {
    const codec = await this.#codec;
    const assembler = this.#assembler;
    if (codec === null || generation < assembler.generation) return;
    assembler.begin(generation, codec);
    const reader = stream.getReader();
    for (;;) {
      const { value: payload, done } = await reader.read().catch(() => ({ value: undefined, done: true }));
      if (done || payload === undefined || assembler.generation !== generation) break;
      const { sequenceNumber, receiveTime = Number.NaN } = payload.getMetadata();
      assembler.take(payload.data, sequenceNumber, receiveTime);
    }
    reader.cancel().catch(() => undefined);
  }

  /** Reports the session's totals. */
  report(): void {
    this.#assembler.report();
  }

  async #beginStream(message: ToCloudWorker & { type: 'cloudStream' }): Promise<void> {
    const codec = await this.#codec;
    if (codec === null || message.generation < this.#assembler.generation) return;
    this.#assembler.begin(message.generation, codec);
    this.#assembler.beginStream(codec, message.format, message.header, message.sensor);
  }

  #takeFromBridge(url: string, generation: number): void {
    const assembler = this.#assembler;
    this.#bridge ??= new BridgeStream(url, assembler.pool, { flush: (batch) => assembler.handOver(batch) });
    this.#bridge.restart();
    assembler.beginCounting(generation, this.#bridge.intake);
  }
}
