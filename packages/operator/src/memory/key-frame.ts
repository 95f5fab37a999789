/**
 * A frame on its way to the memory: the camera's pose, and a thinned sample of what it saw, in one buffer that is
 * transferred to the memory's worker and comes back for reuse.
 *
 *     0    f64 when it arrived, ms since the memory began     8 f64 when it was captured, µs on the robot's clock, wraps at 2³²
 *    16    u32 number of samples                              20 u32 1: samples are of tiles, 0: of points
 *    24    f32 ×3 position of the camera, m                   36 f32 ×4 its orientation x, y, z, w
 *    52    f32 metres of a step of points' coordinates        56 f32 ×4 fx, fy, cx, cy of the tiles' image, pixels
 *    72    u32 number of the sensor
 *    80    samples of 8 bytes, as the cloud worker hands them on (cloud/batch.ts). Of a tile: u16 ×2 column and row in the
 *          image, u32 inverse depth and colour. Of points: int16 ×4 x, y, z, colour.
 */
import type { TileGrid } from '../cloud/batch.ts';

/** The most samples of a frame. */
export const KEY_FRAME_SAMPLES = 65_536;
const HEADER_BYTES = 80;
export const KEY_FRAME_BYTES = HEADER_BYTES + KEY_FRAME_SAMPLES * 8;

export class KeyFrame {
  readonly buffer: ArrayBuffer;
  /** Two for each sample. */
  readonly words: Uint32Array;
  /** Four for each sample of points. */
  readonly shorts: Int16Array;
  readonly #f64: Float64Array;
  readonly #f32: Float32Array;
  readonly #u32: Uint32Array;

  /** @param buffer {@link KEY_FRAME_BYTES} long */
  constructor(buffer: ArrayBuffer) {
    this.buffer = buffer;
    this.words = new Uint32Array(buffer, HEADER_BYTES);
    this.shorts = new Int16Array(buffer, HEADER_BYTES);
    this.#f64 = new Float64Array(buffer, 0, 2);
    this.#f32 = new Float32Array(buffer, 0, HEADER_BYTES / 4);
    this.#u32 = new Uint32Array(buffer, 0, HEADER_BYTES / 4);
  }

  /** When it arrived, ms since the memory began. */
  get arrivedMs(): number {
    return this.#f64[0] as number;
  }
  set arrivedMs(arrivedMs: number) {
    this.#f64[0] = arrivedMs;
  }
  /** When it was captured, µs on the robot's clock; wraps at 2³². */
  get capturedUs(): number {
    return this.#f64[1] as number;
  }
  set capturedUs(capturedUs: number) {
    this.#f64[1] = capturedUs;
  }
  /** Number of samples. */
  get samples(): number {
    return this.#u32[4] as number;
  }
  set samples(samples: number) {
    this.#u32[4] = samples;
  }
  /** Whether samples are of tiles; otherwise of points. */
  get isTiles(): boolean {
    return this.#u32[5] === 1;
  }
  set isTiles(isTiles: boolean) {
    this.#u32[5] = Number(isTiles);
  }
  /** Number of the sensor. */
  get sensor(): number {
    return this.#u32[18] as number;
  }
  set sensor(sensor: number) {
    this.#u32[18] = sensor;
  }
  /** Metres of one step of points' coordinates. */
  get unit(): number {
    return this.#f32[13] as number;
  }
  set unit(unit: number) {
    this.#f32[13] = unit;
  }

  /** The camera's pose in the world. @param component 0–2: x, y, z, metres; 3–6: orientation x, y, z, w */
  pose(component: number): number {
    return this.#f32[6 + component] as number;
  }
  setPose(component: number, value: number): void {
    this.#f32[6 + component] = value;
  }

  /** The camera that tiles were seen by. @param component fx, fy, cx, cy, pixels */
  lens(component: number): number {
    return this.#f32[14 + component] as number;
  }
  setLens({ fx, fy, cx, cy }: Pick<TileGrid, 'fx' | 'fy' | 'cx' | 'cy'>): void {
    this.#f32[14] = fx;
    this.#f32[15] = fy;
    this.#f32[16] = cx;
    this.#f32[17] = cy;
  }

  /** Adds a pixel of a tile; ignored when there is no room. @param sample as in a batch */
  addPixel(column: number, row: number, sample: number): void {
    const at = this.samples;
    if (at >= KEY_FRAME_SAMPLES) return;
    this.words[at * 2] = column | (row << 16);
    this.words[at * 2 + 1] = sample;
    this.samples = at + 1;
  }

  /** Adds a point; ignored when there is no room. @param points of a batch @param from index of its x */
  addPoint(points: Int16Array, from: number): void {
    const at = this.samples;
    if (at >= KEY_FRAME_SAMPLES) return;
    for (let i = 0; i < 4; i++) this.shorts[at * 4 + i] = points[from + i] as number;
    this.samples = at + 1;
  }
}
