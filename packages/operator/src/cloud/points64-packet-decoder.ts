import { type Placement, type PointPacketHeader, pointsOfBytes } from '@farpoint/protocol';
import { CloudDecoder, type Codec } from '@farpoint/wasm-codec';
import { BATCH_PACKETS, type Batch, type PointLook, SAMPLED_COVER } from './batch.ts';
import { copyThinned } from './decoded-points.ts';
import { ImageExtent } from './image-extent.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';

/** Decodes `points64`. A batch's packets are unpacked together when it is handed over, and are all thinned alike. */
export class Points64PacketDecoder implements PacketDecoder {
  readonly #decoder: CloudDecoder;
  readonly #extent = new ImageExtent();
  readonly #look: PointLook = { imageExtent: 0, unit: 0.001, cover: SAMPLED_COVER };
  #waiting = 0;
  #every = 1;

  constructor(codec: Codec) {
    this.#decoder = new CloudDecoder(codec, BATCH_PACKETS);
  }

  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void {
    const points = pointsOfBytes(header.sequenceLength);
    const drawn = Math.ceil(points / writer.everySample);
    const batch = writer.batchFor(drawn);
    if (batch === null) {
      writer.drop('no-buffer');
      return;
    }
    this.#decoder.put(data);
    this.#every = writer.everySample;
    this.#waiting++;
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    this.#extent.add(header.frameNumber, view, 0, points);
    this.#look.imageExtent = this.#extent.value;
    this.#look.cover = SAMPLED_COVER * Math.sqrt(writer.everySample);
    batch.add(header, placement, drawn, receivedAtMs, this.#look);
  }

  settle(): void {}

  finish(batch: Batch): void {
    // A batch holds packets of one format only, so they begin at its first point.
    if (this.#waiting === 0) return;
    const points = this.#decoder.unpack();
    this.#waiting = 0;
    if (this.#every === 1) {
      batch.points.set(points);
      return;
    }
    let first = 0;
    let at = 0;
    for (let packet = 0; packet < batch.packets; packet++) {
      const came = batch.pointsCame(packet);
      copyThinned(points, first, came, this.#every, batch.points, at);
      first += came;
      at += batch.pointsOf(packet) * 4;
    }
  }

  abandon(): void {
    if (this.#waiting > 0) this.#decoder.unpack();
    this.#waiting = 0;
  }
}
