/** Converts a colour and a depth image to a frame of points. */
import type { CameraIntrinsics } from '@farpoint/protocol';
import { decode as decodePng } from 'fast-png';
import jpeg from 'jpeg-js';
import * as z from 'zod';

/** Unusable images or intrinsics. */
export class RgbdError extends Error {
  override readonly name = 'RgbdError';
}

/** Pixels along a side. Chosen: above usual depth cameras; 16 million points still fit the memory. */
const MAX_SIDE = 4096;

/** Open3D's camera file: the matrix in column-major order. */
const intrinsicsSchema = z.object({
  width: z.int().min(1).max(MAX_SIDE),
  height: z.int().min(1).max(MAX_SIDE),
  intrinsic_matrix: z.array(z.number()).length(9),
});

/** @throws {RgbdError} */
export function parseIntrinsics(text: string): CameraIntrinsics {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new RgbdError(`intrinsics: not JSON: ${String(error)}`);
  }
  const parsed = intrinsicsSchema.safeParse(json);
  if (!parsed.success) {
    const issue = parsed.error.issues[0];
    throw new RgbdError(`intrinsics: ${issue?.path.join('.') ?? ''}: ${issue?.message ?? 'not valid'}`);
  }
  const { width, height, intrinsic_matrix: m } = parsed.data;
  const [fx, , , , fy, , cx, cy] = m as [number, number, number, number, number, number, number, number];
  if (!(fx > 0) || !(fy > 0)) throw new RgbdError('intrinsics: the focal lengths are not above zero');
  return { width, height, fx, fy, cx, cy };
}

export interface DepthImage {
  width: number;
  height: number;
  /** Millimetres, 0 where nothing was measured; row by row. */
  millimetres: Uint16Array;
}

/** @throws {RgbdError} for anything but a 16-bit grey PNG */
export function decodeDepthPng(file: Uint8Array): DepthImage {
  let image: ReturnType<typeof decodePng>;
  try {
    image = decodePng(file, { checkCrc: true });
  } catch (error) {
    throw new RgbdError(`depth: ${error instanceof Error ? error.message : String(error)}`);
  }
  const { width, height, depth, channels, data } = image;
  if (depth !== 16 || channels !== 1 || !(data instanceof Uint16Array)) {
    throw new RgbdError(`depth: ${depth} bits and ${channels} channels, not 16 bits of grey`);
  }
  return { width, height, millimetres: data };
}

export interface ColourImage {
  width: number;
  height: number;
  /** R, G, B, 255; row by row. */
  rgba: Uint8Array;
}

/** @throws {RgbdError} */
export function decodeColourJpeg(file: Uint8Array): ColourImage {
  try {
    const { width, height, data } = jpeg.decode(file, {
      useTArray: true,
      formatAsRGBA: true,
      maxResolutionInMP: 17,
      maxMemoryUsageInMB: 512,
    });
    return { width, height, rgba: data };
  } catch (error) {
    throw new RgbdError(`colour: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/**
 * Depth in metres and colour as words, with equal sizes.
 *
 * @returns depth along z, 0 where none was measured; R, G, B, 255 of each pixel, R lowest
 * @throws {RgbdError} if the sizes differ
 */
export function imagesOfRgbd(
  depth: DepthImage,
  colour: ColourImage,
  camera: CameraIntrinsics,
): { depth: Float32Array; colour: Uint32Array } {
  const { width, height } = camera;
  for (const [what, image] of [
    ['depth', depth],
    ['colour', colour],
  ] as const) {
    if (image.width !== width || image.height !== height) {
      throw new RgbdError(
        `${what}: ${image.width}×${image.height} pixels, the intrinsics are for ${width}×${height}`,
      );
    }
  }
  const metres = Float32Array.from(depth.millimetres, (millimetres) => millimetres / 1000);
  const words = new Uint32Array(width * height);
  new Uint8Array(words.buffer).set(colour.rgba.subarray(0, words.byteLength));
  return { depth: metres, colour: words };
}

/**
 * Every pixel's point in the optical frame, metres; NaN where no depth was measured.
 *
 * @returns 4 words per point: x, y, z and the bytes R, G, B, 255
 * @throws {RgbdError} if the sizes differ
 */
export function pointsOfRgbd(depth: DepthImage, colour: ColourImage, camera: CameraIntrinsics): Float32Array {
  const { width, height, fx, fy, cx, cy } = camera;
  const images = imagesOfRgbd(depth, colour, camera);
  const points = new Float32Array(width * height * 4);
  const words = new Uint32Array(points.buffer);
  for (let v = 0; v < height; v++) {
    for (let u = 0; u < width; u++) {
      const i = v * width + u;
      const z = images.depth[i] as number;
      points[i * 4] = z > 0 ? ((u - cx) / fx) * z : Number.NaN;
      points[i * 4 + 1] = z > 0 ? ((v - cy) / fy) * z : Number.NaN;
      points[i * 4 + 2] = z > 0 ? z : Number.NaN;
      words[i * 4 + 3] = images.colour[i] as number;
    }
  }
  return points;
}
