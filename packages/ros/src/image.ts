/** Converts depth and colour images of sensor_msgs, and their camera description, to arrays of one size. */
import { RosFault } from './fault.ts';
import type { CameraInfo, Image } from './messages.ts';

/** Pinhole model of a camera, pixels; pixel centres are at integer coordinates. */
export interface Pinhole {
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

/** Colour of pixels without colour: light grey, opaque. */
export const GREY = 0xffc8_c8c8;
const OPAQUE = 0xff00_0000;

const DEPTH_BYTES: ReadonlyMap<string, number> = new Map([
  ['16UC1', 2],
  ['mono16', 2],
  ['32FC1', 4],
]);
/** Positions of red, green and blue in a pixel, and its number of bytes. */
const COLOURS: ReadonlyMap<string, readonly [number, number, number, number]> = new Map([
  ['rgb8', [0, 1, 2, 3]],
  ['bgr8', [2, 1, 0, 3]],
  ['rgba8', [0, 1, 2, 4]],
  ['bgra8', [2, 1, 0, 4]],
  ['mono8', [0, 0, 0, 1]],
  ['8UC1', [0, 0, 0, 1]],
  ['8UC3', [2, 1, 0, 3]],
]);

/**
 * Reads depth along z.
 *
 * @param into width × height; metres, 0 where none was measured (unchanged for 32FC1: NaN, infinite)
 * @throws {RosFault} `bad-image`, `unsupported`, `too-large`
 */
export function depthOf(image: Image, into: Float32Array): void {
  const { width, height, step, encoding, data } = image;
  const bytes = DEPTH_BYTES.get(encoding);
  if (bytes === undefined) {
    throw new RosFault('unsupported', `depth as ${encoding || 'nothing'}`, {
      remedy: `the encodings are ${[...DEPTH_BYTES.keys()].join(', ')}`,
    });
  }
  if (checkedPixels(image, bytes, into.length) === 0) return;
  const little = !image.is_bigendian;
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  let to = 0;
  for (let row = 0; row < height; row++) {
    let at = row * step;
    if (bytes === 2) {
      for (let i = 0; i < width; i++, at += 2) into[to++] = view.getUint16(at, little) / 1000;
    } else {
      for (let i = 0; i < width; i++, at += 4) into[to++] = view.getFloat32(at, little);
    }
  }
}

/**
 * @param into width × height; R, G, B, 255, R lowest
 * @throws {RosFault} `bad-image`, `unsupported`, `too-large`
 */
export function colourOf(image: Image, into: Uint32Array): void {
  const { width, height, step, encoding, data } = image;
  const layout = COLOURS.get(encoding);
  if (layout === undefined) {
    throw new RosFault('unsupported', `colour as ${encoding || 'nothing'}`, {
      remedy: `the encodings are ${[...COLOURS.keys()].join(', ')}`,
    });
  }
  const [red, green, blue, bytes] = layout;
  if (checkedPixels(image, bytes, into.length) === 0) return;
  let to = 0;
  for (let row = 0; row < height; row++) {
    let at = row * step;
    for (let i = 0; i < width; i++, at += bytes) {
      into[to++] =
        ((data[at + red] as number) |
          ((data[at + green] as number) << 8) |
          ((data[at + blue] as number) << 16) |
          OPAQUE) >>>
        0;
    }
  }
}

/**
 * The camera of rectified images, which depth images are, if it is given; else that of raw images.
 *
 * @throws {RosFault} `bad-image`
 */
export function pinholeOf({ k, p }: CameraInfo): Pinhole {
  const matrix = p !== undefined && (p[0] as number) > 0 ? { m: p, stride: 4 } : { m: k, stride: 3 };
  const at = (row: number, column: number) => matrix.m?.[row * matrix.stride + column] ?? Number.NaN;
  const [fx, fy, cx, cy] = [at(0, 0), at(1, 1), at(0, 2), at(1, 2)];
  if (!(fx > 0 && fy > 0 && Number.isFinite(fx + fy + cx + cy))) {
    throw new RosFault('bad-image', `focal lengths of ${fx} and ${fy} pixels`, {
      remedy: 'calibrate the camera',
    });
  }
  return { fx, fy, cx, cy };
}

/**
 * Checks that the data is as long as the image's size requires.
 *
 * @returns width × height
 * @throws {RosFault} `bad-image`, `too-large`
 */
export function checkedPixels({ width, height, step, data }: Image, bytes: number, room: number): number {
  const pixels = width * height;
  if (pixels > room) {
    throw new RosFault('too-large', `${width} × ${height} pixels, room for ${room}`);
  }
  if (pixels === 0) return 0;
  if (step < width * bytes) {
    throw new RosFault('bad-image', `a row of ${step} bytes for ${width} pixels of ${bytes}`);
  }
  const needed = (height - 1) * step + width * bytes;
  if (data.length < needed) {
    throw new RosFault('bad-image', `the data ends, ${needed} bytes expected`, { offset: data.length });
  }
  return pixels;
}
