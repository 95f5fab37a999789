import type { Placement, PointPacketHeader } from '@farpoint/protocol';
import { CloudDecoder, type Codec } from '@farpoint/wasm-codec';
import { BATCH_PACKETS, type Batch, type PointLook, SAMPLED_COVER } from './batch.ts';
import { ImageExtent } from './image-extent.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';
import type { DropReason } from './packet-intake.ts';

/** `points64`: a batch's packets are unpacked together, when it is handed over. */
export class Points64PacketDecoder implements PacketDecoder {
  readonly #decoder: CloudDecoder;
  readonly #extent = new ImageExtent();
  readonly #look: PointLook = { imageExtent: 0, unit: 0.001, cover: SAMPLED_COVER };
  #waiting = 0;

  constructor(codec: Codec) {
    this.#decoder = new CloudDecoder(codec, BATCH_PACKETS);
  }

  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedMs: number,
    writer: BatchWriter,
  ): DropReason | null {
    const points = header.sequenceLength / 8;
    const batch = writer.batchFor(points);
    if (batch === null) return 'no-buffer';
    this.#decoder.put(data);
    this.#waiting++;
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    this.#extent.add(header.frameNumber, view, 0, points);
    this.#look.imageExtent = this.#extent.value;
    batch.add(header, placement, points, receivedMs, this.#look);
    return null;
  }

  finish(batch: Batch): void {
    // A batch holds packets of one format: these begin at its first point.
    if (this.#waiting > 0) batch.points.set(this.#decoder.unpack());
    this.#waiting = 0;
  }

  abandon(): void {
    if (this.#waiting > 0) this.#decoder.unpack();
    this.#waiting = 0;
  }
}
