/**
 * Picks key frames out of what is decoded, of one sensor: every so often the packets of one frame, thinned. Time is an
 * argument; copies what it keeps.
 */

import { sequenceDelta32 } from '@farpoint/protocol';
import { TILE } from '@farpoint/wasm-codec';
import { type Batch, TILE_ROOM, type TileGrid } from '../cloud/batch.ts';
import { KEY_FRAME_SAMPLES, type KeyFrame } from './key-frame.ts';

/**
 * A key frame begins this long after the one before, ms. `pnpm bench memory` measures what a frame takes in
 * the worker and how much is remembered with four a second (docs/memory.md).
 */
const INTERVAL_MS = 250;

export interface KeyFrameSink {
  /** An empty key frame; `null` while none is free. */
  takeFrame(): KeyFrame | null;
  /** A key frame is filled. */
  sendFrame(frame: KeyFrame): void;
}

export class KeyFrameFeed {
  readonly #sink: KeyFrameSink;
  readonly #grid: TileGrid = { width: 0, height: 0, fx: 0, fy: 0, cx: 0, cy: 0 };
  #frame: KeyFrame | null = null;
  #number = 0;
  #stride = 1;
  #beganMs = Number.NEGATIVE_INFINITY;
  /** Points until the next one that is taken. */
  #skip = 0;

  constructor(sink: KeyFrameSink) {
    this.#sink = sink;
  }

  /** Drops what is being filled. */
  abandon(): KeyFrame | null {
    const frame = this.#frame;
    this.#frame = null;
    return frame;
  }

  /** @param nowMs milliseconds since the memory began */
  take(batch: Batch, nowMs: number): void {
    let at = 0;
    for (let packet = 0; packet < batch.packets; packet++) {
      const frame = this.#frameOf(batch, packet, nowMs);
      if (frame !== null) {
        if (frame.isTiles) this.#addTiles(frame, batch, packet, at);
        else this.#addPoints(frame, batch, packet, at);
        const end = batch.sequenceOffset(packet) + batch.sequenceLength(packet);
        if (end === batch.frameLength(packet)) this.#send();
      }
      at += batch.pointsOf(packet);
    }
  }

  /** The key frame that a packet belongs to; `null` if to none. */
  #frameOf(batch: Batch, packet: number, nowMs: number): KeyFrame | null {
    const number = batch.frameNumber(packet);
    const isTiles = batch.tilesOf(packet) > 0;
    const filling = this.#frame;
    if (filling !== null) {
      if (number === this.#number && filling.isTiles === isTiles) return filling;
      if (sequenceDelta32(number, this.#number) > 0) this.#send();
      else return null;
    }
    // A frame that has begun already would be seen in part only.
    if (nowMs - this.#beganMs < INTERVAL_MS || batch.sequenceOffset(packet) !== 0) return null;
    // Its colours are not those of the world.
    if (batch.isLatencyTest(packet)) return null;
    const frame = this.#sink.takeFrame();
    if (frame === null) return null;
    this.#frame = frame;
    this.#number = number;
    this.#beganMs = nowMs;
    this.#begin(frame, batch, packet, isTiles, nowMs);
    return frame;
  }

  #begin(frame: KeyFrame, batch: Batch, packet: number, isTiles: boolean, nowMs: number): void {
    frame.samples = 0;
    frame.sensor = batch.sensor;
    frame.arrivedMs = nowMs;
    frame.capturedUs = batch.captureTimeUs(packet);
    frame.isTiles = isTiles;
    frame.unit = batch.unit(packet);
    for (let i = 0; i < 7; i++) frame.setPose(i, batch.poseComponent(packet, i));
    if (isTiles) {
      batch.readGrid(packet, this.#grid);
      frame.setLens(this.#grid);
    }
    const points = isTiles ? this.#grid.width * this.#grid.height : batch.frameLength(packet) / 8;
    const every = Math.max(points / KEY_FRAME_SAMPLES, 1);
    this.#stride = isTiles ? Math.min(2 ** Math.ceil(Math.log2(every) / 2), TILE) : Math.ceil(every);
    this.#skip = 0;
  }

  #addTiles(frame: KeyFrame, batch: Batch, packet: number, at: number): void {
    const { width, height } = this.#grid;
    const { samples } = batch;
    const columns = Math.ceil(width / TILE);
    const first = batch.firstTile(packet);
    const stride = this.#stride;
    for (let tile = first; tile < first + batch.tilesOf(packet); tile++) {
      const from = (at + (tile - first) * TILE_ROOM) * 2;
      const [left, top] = [(tile % columns) * TILE, Math.floor(tile / columns) * TILE];
      for (let y = 0; y < TILE && top + y < height; y += stride) {
        for (let x = 0; x < TILE && left + x < width; x += stride) {
          const sample = samples[from + y * TILE + x] as number;
          if ((sample & 0xffff) !== 0) frame.addPixel(left + x, top + y, sample);
        }
      }
    }
  }

  #addPoints(frame: KeyFrame, batch: Batch, packet: number, at: number): void {
    const points = batch.pointsOf(packet);
    for (; this.#skip < points; this.#skip += this.#stride)
      frame.addPoint(batch.points, (at + this.#skip) * 4);
    this.#skip -= points;
  }

  #send(): void {
    const frame = this.#frame;
    this.#frame = null;
    if (frame !== null) this.#sink.sendFrame(frame);
  }
}
