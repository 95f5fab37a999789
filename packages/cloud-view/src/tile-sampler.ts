/** Shows the colouring a few of a surface's samples as points, so that automatic ranges follow what is in view. */
import type { Batch, TileGrid } from '@farpoint/operator';
import { DataUtils } from 'three';
import type { PointColouring } from './point-colouring.ts';
import { TILE } from './tile-geometry.ts';
import { TILE_SAMPLES } from './tile-textures.ts';

/** Samples looked at of each packet. */
const PER_PACKET = 4;

export class TileSampler {
  /** As if a frame had so few points that each is looked at. */
  readonly total = 1;
  readonly #points = new Int16Array(PER_PACKET * 4);
  readonly #grid: TileGrid = { width: 0, height: 0, fx: 1, fy: 1, cx: 0, cy: 0 };

  /**
   * @param at the batch's sample, in points' room, at which the packet's begin
   * @param slot of the colouring's two frames
   */
  sample(batch: Batch, packet: number, at: number, colouring: PointColouring, slot: number): void {
    const grid = this.#grid;
    batch.readGrid(packet, grid);
    const columns = Math.ceil(grid.width / TILE);
    const unit = batch.unit(packet);
    const samples = batch.tilesOf(packet) * TILE_SAMPLES;
    let count = 0;
    for (let i = 0; i < PER_PACKET; i++) {
      const index = Math.floor(((i + 0.5) * samples) / PER_PACKET);
      const sample = batch.samples[at * 2 + index] as number;
      const inverse = DataUtils.fromHalfFloat(sample & 0xffff);
      if (inverse === 0) continue;
      const tile = batch.firstTile(packet) + Math.floor(index / TILE_SAMPLES);
      const u = (tile % columns) * TILE + (index % TILE);
      const v = Math.floor(tile / columns) * TILE + (Math.floor(index / TILE) % TILE);
      const steps = 1 / (inverse * unit);
      const point = count * 4;
      this.#points[point] = (steps * (u - grid.cx)) / grid.fx;
      this.#points[point + 1] = (steps * (v - grid.cy)) / grid.fy;
      this.#points[point + 2] = steps;
      this.#points[point + 3] = bits664(sample >>> 16);
      count++;
    }
    colouring.sample(this.#points, 0, count, slot);
  }
}

/** From 5-6-5 bits. */
function bits664(colour: number): number {
  return ((colour >> 11) << 11) | (((colour >> 5) & 63) << 4) | ((colour & 31) >> 1);
}
