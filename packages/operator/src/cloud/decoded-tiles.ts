import type { Placement, PointPacketHeader } from '@farpoint/protocol';
import { TILE_SAMPLES } from '@farpoint/wasm-codec';
import { BATCH_TILES, type PointLook, type TileGrid } from './batch.ts';
import type { BatchWriter } from './packet-decoder.ts';

/** Hands a decoded packet's tiles on. A packet with more tiles than fit into a batch continues in the next ones. */
export class DecodedTiles {
  readonly #part: PointPacketHeader = {
    frameNumber: 0,
    frameLength: 0,
    sequenceOffset: 0,
    sequenceLength: 0,
  };

  /**
   * @param samples of all of the image's tiles
   * @param firstTile number of the packet's first tile
   * @param tiles how many it has
   */
  write(
    samples: Uint32Array,
    firstTile: number,
    tiles: number,
    header: PointPacketHeader,
    placement: Placement,
    receivedAtMs: number,
    look: PointLook,
    grid: TileGrid,
    writer: BatchWriter,
  ): void {
    const part = Object.assign(this.#part, header);
    const end = firstTile + tiles;
    for (let first = firstTile; first < end; ) {
      const count = Math.min(end - first, BATCH_TILES);
      const batch = writer.batchFor(count * (TILE_SAMPLES / 2));
      if (batch === null) {
        writer.drop('no-buffer');
        return;
      }
      const from = first * TILE_SAMPLES;
      batch.samples.set(samples.subarray(from, from + count * TILE_SAMPLES), batch.pointCount * 2);
      batch.addTiles(part, placement, first, count, receivedAtMs, look, grid);
      first += count;
      // The packet's points came once, however many parts it has.
      part.sequenceOffset = header.sequenceOffset + header.sequenceLength;
      part.sequenceLength = 0;
    }
  }
}
