/** The bridge's streaming socket, in the cloud worker. Reconnects without end, and hands each frame on in batches. */

import { packetCountOf } from '@farpoint/protocol';
import { Backoff } from '@farpoint/timing';
import type { Batch } from '../cloud/batch.ts';
import type { BatchPool } from '../cloud/batch-pool.ts';
import { ImageExtent } from '../cloud/image-extent.ts';
import { countDrop, PacketIntake } from '../cloud/packet-intake.ts';
import { splitFrame } from './bridge-frame.ts';
import { BRIDGE_RETRY } from './bridge-socket.ts';

export interface BridgeStreamPort {
  /** Hands a filled batch to the page. */
  flush(batch: Batch): void;
}

export class BridgeStream {
  /** Totals of this session, as for a direct one. */
  intake = new PacketIntake();
  readonly #url: string;
  readonly #pool: BatchPool;
  readonly #port: BridgeStreamPort;
  readonly #backoff = new Backoff({ ...BRIDGE_RETRY, random: Math.random });
  #extent = new ImageExtent();
  #frame = 0;
  #batch: Batch | null = null;
  busyMs = 0;

  constructor(url: string, pool: BatchPool, port: BridgeStreamPort) {
    this.#url = url;
    this.#pool = pool;
    this.#port = port;
    this.#connect();
  }

  /** The robot has changed: restarts the counters. */
  restart(): void {
    this.intake = new PacketIntake();
    this.#extent = new ImageExtent();
    this.#frame = 0;
  }

  #connect(): void {
    const socket = new WebSocket(this.#url);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.#backoff.reset();
    socket.onmessage = ({ data }: MessageEvent<unknown>) => {
      if (data instanceof ArrayBuffer) this.#onFrame(data);
    };
    socket.onclose = () => setTimeout(() => this.#connect(), this.#backoff.nextMs());
  }

  #onFrame(message: ArrayBuffer): void {
    const began = performance.now();
    const { intake } = this;
    const sink = { next: () => this.#next() };
    const outcome = splitFrame(message, this.#frame++, performance.timeOrigin + began, this.#extent, sink);
    if (outcome === null) {
      countDrop(intake.drops, 'bad-frame-length');
    } else {
      intake.packetsReceived += packetCountOf(outcome.points + outcome.dropped);
      if (outcome.dropped > 0) countDrop(intake.drops, 'no-buffer', packetCountOf(outcome.dropped));
    }
    intake.bytesReceived += message.byteLength;
    const batch = this.#batch;
    this.#batch = null;
    if (batch !== null) this.#port.flush(batch);
    this.busyMs += performance.now() - began;
  }

  #next(): Batch | null {
    if (this.#batch?.full) {
      this.#port.flush(this.#batch);
      this.#batch = null;
    }
    this.#batch ??= this.#pool.take();
    return this.#batch;
  }
}
