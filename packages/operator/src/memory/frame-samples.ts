/** A key frame's samples as places in the camera's frame (metres, z forward, x right, y down). Allocates nothing. */
import { KEY_FRAME_SAMPLES, type KeyFrame } from './key-frame.ts';

/** The values of all positive half floats. */
const HALVES = Float32Array.from({ length: 32_768 }, (_, bits) => {
  const [exponent, fraction] = [bits >> 10, bits & 1023];
  if (exponent === 31) return Number.POSITIVE_INFINITY;
  return exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
});

export class FrameSamples {
  readonly x = new Float32Array(KEY_FRAME_SAMPLES);
  readonly y = new Float32Array(KEY_FRAME_SAMPLES);
  readonly z = new Float32Array(KEY_FRAME_SAMPLES);
  /** Distances from the camera. */
  readonly ranges = new Float32Array(KEY_FRAME_SAMPLES);
  /** 5-6-5 bits, R highest. */
  readonly colours = new Uint16Array(KEY_FRAME_SAMPLES);
  count = 0;

  read(frame: KeyFrame): void {
    this.count = 0;
    if (frame.isTiles) this.#readPixels(frame);
    else this.#readPoints(frame);
  }

  #readPixels(frame: KeyFrame): void {
    const { words } = frame;
    const [fx, fy, cx, cy] = [frame.lens(0), frame.lens(1), frame.lens(2), frame.lens(3)];
    const samples = Math.min(frame.samples, KEY_FRAME_SAMPLES);
    for (let i = 0; i < samples; i++) {
      const pixel = words[i * 2] as number;
      const sample = words[i * 2 + 1] as number;
      const inverse = HALVES[sample & 0x7fff] as number;
      if (inverse === 0 || inverse === Number.POSITIVE_INFINITY) continue;
      const z = 1 / inverse;
      this.#add(((pixel & 0xffff) - cx) * (z / fx), ((pixel >>> 16) - cy) * (z / fy), z, sample >>> 16);
    }
  }

  #readPoints({ shorts, samples, unit }: KeyFrame): void {
    for (let i = 0; i < Math.min(samples, KEY_FRAME_SAMPLES); i++) {
      const x = (shorts[i * 4] as number) * unit;
      const y = (shorts[i * 4 + 1] as number) * unit;
      const z = (shorts[i * 4 + 2] as number) * unit;
      // Points have 6, 6 and 4 bits.
      const colour = (shorts[i * 4 + 3] as number) & 0xffff;
      const [red, green, blue] = [colour >> 10, (colour >> 4) & 63, colour & 15];
      this.#add(x, y, z, ((red >> 1) << 11) | (green << 5) | ((blue << 1) | (blue >> 3)));
    }
  }

  #add(x: number, y: number, z: number, colour: number): void {
    const range = Math.sqrt(x * x + y * y + z * z);
    if (!(range > 0 && range < Number.POSITIVE_INFINITY)) return;
    const at = this.count++;
    this.x[at] = x;
    this.y[at] = y;
    this.z[at] = z;
    this.ranges[at] = range;
    this.colours[at] = colour;
  }
}
