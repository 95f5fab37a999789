/** How a drawn picture differs from the true one. */

/** A square picture. */
export interface Picture {
  /** R, G, B, A of each pixel. */
  colour: Uint8Array;
  /** Depth along z, metres; 0 where there is nothing. */
  depth: Float32Array;
}

export interface PictureDifference {
  /** Share of the pixels in which the true picture has something and the drawn one has not. */
  holes: number;
  /** Structural similarity of the brightness, 1 for the same picture (Wang et al. 2004, in blocks of 8 × 8 pixels). */
  ssim: number;
  /** Median of the difference of depth where both have something, metres. */
  depthErrorM: number;
}

const BLOCK = 8;
const C1 = (0.01 * 255) ** 2;
const C2 = (0.03 * 255) ** 2;

/** @param size width and height of both, pixels */
export function differenceOf(drawn: Picture, truth: Picture, size: number): PictureDifference {
  let there = 0;
  let missing = 0;
  const errors: number[] = [];
  for (let i = 0; i < size * size; i++) {
    const depth = truth.depth[i] as number;
    if (depth <= 0) continue;
    there++;
    const own = drawn.depth[i] as number;
    if (own === 0) missing++;
    else errors.push(Math.abs(own - depth));
  }
  errors.sort((a, b) => a - b);
  return {
    holes: there === 0 ? 0 : missing / there,
    ssim: ssim(brightness(drawn.colour), brightness(truth.colour), size),
    depthErrorM: errors[Math.floor(errors.length / 2)] ?? Number.NaN,
  };
}

function brightness(rgba: Uint8Array): Float32Array {
  const luma = new Float32Array(rgba.length / 4);
  for (let i = 0; i < luma.length; i++) {
    const [r, g, b] = [rgba[i * 4] as number, rgba[i * 4 + 1] as number, rgba[i * 4 + 2] as number];
    luma[i] = 0.299 * r + 0.587 * g + 0.114 * b;
  }
  return luma;
}

function ssim(a: Float32Array, b: Float32Array, size: number): number {
  let sum = 0;
  let blocks = 0;
  for (let y = 0; y + BLOCK <= size; y += BLOCK) {
    for (let x = 0; x + BLOCK <= size; x += BLOCK) {
      sum += blockSsim(a, b, y * size + x, size);
      blocks++;
    }
  }
  return sum / blocks;
}

function blockSsim(a: Float32Array, b: Float32Array, start: number, size: number): number {
  const n = BLOCK * BLOCK;
  let [sumA, sumB, sumAa, sumBb, sumAb] = [0, 0, 0, 0, 0];
  for (let y = 0; y < BLOCK; y++) {
    for (let x = 0; x < BLOCK; x++) {
      const [p, q] = [a[start + y * size + x] as number, b[start + y * size + x] as number];
      sumA += p;
      sumB += q;
      sumAa += p * p;
      sumBb += q * q;
      sumAb += p * q;
    }
  }
  const [meanA, meanB] = [sumA / n, sumB / n];
  const [varA, varB] = [sumAa / n - meanA ** 2, sumBb / n - meanB ** 2];
  const covariance = sumAb / n - meanA * meanB;
  const top = (2 * meanA * meanB + C1) * (2 * covariance + C2);
  return top / ((meanA ** 2 + meanB ** 2 + C1) * (varA + varB + C2));
}
