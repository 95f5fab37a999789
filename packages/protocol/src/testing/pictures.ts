/** Grey pictures for tests, and what codecs and cameras do to them. */

/** A 32-bit linear congruential generator (Numerical Recipes): whole numbers below `bound`. */
export function generator(seed: number): (bound: number) => number {
  let state = seed >>> 0;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

/** Changes every pixel; what it becomes is limited to 0–255. */
export function changed(luma: Uint8Array, change: (value: number) => number): Uint8Array {
  return Uint8Array.from(Uint8ClampedArray.from(luma, change));
}

/** The mean of each pixel and its eight neighbours; at the edges, of those there are. */
export function blurred(luma: Uint8Array, width: number): Uint8Array {
  const height = luma.length / width;
  return luma.map((_, i) => {
    const x = i % width;
    const y = (i - x) / width;
    let sum = 0;
    let count = 0;
    for (let v = Math.max(0, y - 1); v <= Math.min(height - 1, y + 1); v++) {
      for (let u = Math.max(0, x - 1); u <= Math.min(width - 1, x + 1); u++) {
        sum += luma[v * width + u] as number;
        count++;
      }
    }
    return sum / count;
  });
}

/** Fills a rectangle; what lies outside the picture is left out. */
export function fillRectangle(
  luma: Uint8Array,
  width: number,
  [x, y, w, h]: readonly [number, number, number, number],
  value: number,
): void {
  const right = Math.min(width, x + w);
  for (let row = Math.max(0, y); row < Math.min(luma.length / width, y + h); row++) {
    if (right > x) luma.fill(value, row * width + Math.max(0, x), row * width + right);
  }
}

/** RGBA of luma with chroma, both limited range (ITU-R BT.601), out-of-range colours cut off. */
export function rgbaOf(luma: Uint8Array, cb: number, cr: number): Uint8ClampedArray {
  const rgba = new Uint8ClampedArray(luma.length * 4);
  for (const [i, value] of luma.entries()) {
    const y = 1.164 * (value - 16);
    rgba[4 * i] = y + 1.596 * (cr - 128);
    rgba[4 * i + 1] = y - 0.392 * (cb - 128) - 0.813 * (cr - 128);
    rgba[4 * i + 2] = y + 2.017 * (cb - 128);
    rgba[4 * i + 3] = 255;
  }
  return rgba;
}
