/**
 * Where depth cameras have really looked at a thing, or into a hole of the floor, by their own images and true poses: no part
 * of the guard decides.
 */
import { type Pose, rotationMatrix } from '@farpoint/protocol';
import type { Pinhole } from '@farpoint/wasm-codec';

const CELL_M = 0.05;
/** Cells of each side: as far as a drive of half a minute goes. */
const SIDE = 800;
/** Heights of what the robot can drive against, and that noise on the floor does not reach: metres. */
const [LOWEST_M, HIGHEST_M] = [0.1, 1];
/** A ray goes through the floor's level if it goes on for so much longer. */
const THROUGH = 1.05;
/** The guard looks no farther for holes, metres. */
const HOLES_WITHIN_M = 4;
/** What is seen of a surface may lie in the next cell, by its noise, metres. */
const REACH_M = 0.02;

export class SeenThings {
  /** When a thing was first and last seen over each cell, and when a hole in it, ms. */
  readonly #thingMs = new Float64Array(SIDE * SIDE).fill(Number.POSITIVE_INFINITY);
  readonly #lastThingMs = new Float64Array(SIDE * SIDE).fill(Number.NEGATIVE_INFINITY);
  readonly #holeMs = new Float64Array(SIDE * SIDE).fill(Number.POSITIVE_INFINITY);
  readonly #centre: { x: number; y: number };
  readonly #isHole: (x: number, y: number) => boolean;

  /** @param centre of what is remembered, in the world, metres @param isHole whether there is no floor, in truth */
  constructor(centre: { x: number; y: number }, isHole: (x: number, y: number) => boolean) {
    this.#centre = { x: centre.x, y: centre.y };
    this.#isHole = isHole;
  }

  /** @param depth along z, metres; 0 where there is none @param cameraPose of the optical frame in the world */
  take(
    depth: Float32Array,
    width: number,
    { fx, fy, cx, cy }: Pinhole,
    cameraPose: Pose,
    capturedAtMs: number,
  ): void {
    const [r0, r1, r2, r3, r4, r5, r6, r7, r8] = rotationMatrix(cameraPose.orientation);
    const { x, y, z } = cameraPose.position;
    for (let row = 0, i = 0; i < depth.length; row++) {
      const down = (row - cy) / fy;
      // Without arrays: this runs for each pixel of each image, and is most of the time of a simulated drive.
      const [rowX, rowY, rowZ] = [r1 * down + r2, r4 * down + r5, r7 * down + r8];
      for (let column = 0; column < width; column++, i++) {
        const right = (column - cx) / fx;
        const toZ = r6 * right + rowZ;
        const far = depth[i] as number;
        const height = z + toZ * far;
        const isThing = far > 0 && height >= LOWEST_M && height <= HIGHEST_M;
        const floor = toZ < 0 ? -z / toZ : Number.POSITIVE_INFINITY;
        const isThrough = floor <= HOLES_WITHIN_M && !(far > 0 && far < floor * THROUGH);
        if (!isThing && !isThrough) continue;
        const toX = r0 * right + rowX;
        const toY = r3 * right + rowY;
        if (isThing) {
          const cell = this.#mark(this.#thingMs, x + toX * far, y + toY * far, capturedAtMs);
          if (cell !== null) this.#lastThingMs[cell] = capturedAtMs;
        }
        if (isThrough && this.#isHole(x + toX * floor, y + toY * floor))
          this.#mark(this.#holeMs, x + toX * floor, y + toY * floor, capturedAtMs);
      }
    }
  }

  /** Since when a thing has been seen where a disc touches; infinite where none was, ms. @param lastMs seen at least then */
  thingSinceMs(at: { x: number; y: number }, radius: number, lastMs = Number.NEGATIVE_INFINITY): number {
    return this.#sinceMs(
      this.#thingMs,
      at,
      radius + REACH_M,
      (cell) => (this.#lastThingMs[cell] as number) >= lastMs,
    );
  }

  /** Since when a hole has been seen where a disc stands; infinite where none was, ms. */
  holeSinceMs(at: { x: number; y: number }, radius: number): number {
    return this.#sinceMs(this.#holeMs, at, radius + REACH_M);
  }

  #mark(firstMs: Float64Array, x: number, y: number, atMs: number): number | null {
    const cell = this.#cellOf(x, y);
    if (cell !== null && atMs < (firstMs[cell] as number)) firstMs[cell] = atMs;
    return cell;
  }

  #sinceMs(
    firstMs: Float64Array,
    { x, y }: { x: number; y: number },
    reach: number,
    counts: (cell: number) => boolean = () => true,
  ): number {
    let since = Number.POSITIVE_INFINITY;
    for (let toX = -reach; toX <= reach; toX += CELL_M / 2) {
      for (let toY = -reach; toY <= reach; toY += CELL_M / 2) {
        if (Math.hypot(toX, toY) > reach) continue;
        const cell = this.#cellOf(x + toX, y + toY);
        if (cell !== null && counts(cell)) since = Math.min(since, firstMs[cell] as number);
      }
    }
    return since;
  }

  #cellOf(x: number, y: number): number | null {
    const column = Math.floor((x - this.#centre.x) / CELL_M) + SIDE / 2;
    const row = Math.floor((y - this.#centre.y) / CELL_M) + SIDE / 2;
    return column >= 0 && column < SIDE && row >= 0 && row < SIDE ? row * SIDE + column : null;
  }
}
