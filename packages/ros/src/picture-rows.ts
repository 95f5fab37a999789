/**
 * Converts images of sensor_msgs to pictures for people: row by row, as 8-bit colours, from any encoding.
 *
 * Source: sensor_msgs/image_encodings.hpp. `yuv422` is U Y V Y, `yuv422_yuy2` is Y U Y V; a `bayer_` name gives the
 * upper left square of four pixels, row by row.
 */
import { RosFault } from './fault.ts';
import { checkedPixels } from './image.ts';
import type { Image } from './messages.ts';

/** More pixels than any camera on a robot has. */
export const MOST_PICTURE_PIXELS = 4096 * 4096;
/** Near depth is shown light, depth from this distance on dark, metres; missing depth is black. */
export const DARKEST_DEPTH_M = 8;
const NEAREST_GREY = 255;
const FARTHEST_GREY = 40;

/** Writes one row as R, G, B, 255. */
type RowReader = (image: Image, view: DataView, row: number, into: Uint8Array) => void;

interface Encoding {
  /** Bytes per pixel; 2 if a pair of pixels shares four bytes. */
  bytes: number;
  read: RowReader;
  /** Pixels come in squares or pairs, so these sides must be even. */
  even?: 'width' | 'both';
}

const colour = (bytes: number, red: number, green: number, blue: number): Encoding => ({
  bytes,
  read: ({ data, width, step }, _, row, into) => {
    for (let i = 0, at = row * step; i < width * 4; i += 4, at += bytes) {
      into[i] = data[at + red] as number;
      into[i + 1] = data[at + green] as number;
      into[i + 2] = data[at + blue] as number;
      into[i + 3] = 255;
    }
  },
});

/** @param greyAt 0–255 */
const grey = (
  bytes: number,
  greyAt: (view: DataView, at: number, littleEndian: boolean) => number,
): Encoding => ({
  bytes,
  read: ({ width, step, is_bigendian }, view, row, into) => {
    const little = !is_bigendian;
    for (let i = 0, at = row * step; i < width * 4; i += 4, at += bytes) {
      into[i] = into[i + 1] = into[i + 2] = greyAt(view, at, little);
      into[i + 3] = 255;
    }
  },
});

/**
 * BT.601 in video range, as delivered by cameras.
 *
 * @param luma position of the first of two
 * @param chroma position of U; V is two further on
 */
const yuv = (luma: number, chroma: number): Encoding => ({
  bytes: 2,
  even: 'width',
  read: ({ data, width, step }, _, row, into) => {
    for (let i = 0, at = row * step; i < width * 4; at += 4) {
      const u = (data[at + chroma] as number) - 128;
      const v = (data[at + chroma + 2] as number) - 128;
      for (let n = 0; n < 2; n++, i += 4) {
        const y = 1.164 * ((data[at + luma + n * 2] as number) - 16);
        into[i] = clamp(y + 1.596 * v);
        into[i + 1] = clamp(y - 0.392 * u - 0.813 * v);
        into[i + 2] = clamp(y + 2.017 * u);
        into[i + 3] = 255;
      }
    }
  },
});

/**
 * Combines the four pixels of a square into one colour, averaging the two greens: half the resolution, and no colour
 * fringes.
 */
const bayer = (square: string, bytes: 1 | 2): Encoding => {
  const [red, green, otherGreen, blue] = [
    square.indexOf('r'),
    square.indexOf('g'),
    square.lastIndexOf('g'),
    square.indexOf('b'),
  ];
  return {
    bytes,
    even: 'both',
    read: ({ data, width, step, is_bigendian }, _, row, into) => {
      const top = (row & ~1) * step + (bytes === 2 && !is_bigendian ? 1 : 0);
      // Of 16 bits, the upper eight.
      const value = (pixel: number, place: number) =>
        data[top + (place >> 1) * step + (pixel + (place & 1)) * bytes] as number;
      for (let x = 0, i = 0; x < width; x += 2) {
        const r = value(x, red);
        const g = (value(x, green) + value(x, otherGreen)) >> 1;
        const b = value(x, blue);
        for (let n = 0; n < 2; n++, i += 4) {
          into[i] = r;
          into[i + 1] = g;
          into[i + 2] = b;
          into[i + 3] = 255;
        }
      }
    },
  };
};

const depthGrey = (metres: number): number => {
  if (!(metres > 0) || metres === Number.POSITIVE_INFINITY) return 0;
  const share = Math.min(metres / DARKEST_DEPTH_M, 1);
  return Math.round(NEAREST_GREY - share * (NEAREST_GREY - FARTHEST_GREY));
};

const ENCODINGS: ReadonlyMap<string, Encoding> = new Map([
  ['rgb8', colour(3, 0, 1, 2)],
  ['bgr8', colour(3, 2, 1, 0)],
  ['8UC3', colour(3, 2, 1, 0)],
  ['rgba8', colour(4, 0, 1, 2)],
  ['bgra8', colour(4, 2, 1, 0)],
  ['8UC4', colour(4, 2, 1, 0)],
  ['mono8', colour(1, 0, 0, 0)],
  ['8UC1', colour(1, 0, 0, 0)],
  ['mono16', grey(2, (view, at, little) => view.getUint16(at, little) >> 8)],
  ['16UC1', grey(2, (view, at, little) => depthGrey(view.getUint16(at, little) / 1000))],
  ['32FC1', grey(4, (view, at, little) => depthGrey(view.getFloat32(at, little)))],
  ...(['yuv422', 'uyvy'] as const).map((name) => [name, yuv(1, 0)] as const),
  ...(['yuv422_yuy2', 'yuyv'] as const).map((name) => [name, yuv(0, 1)] as const),
  ...(['rggb', 'bggr', 'gbrg', 'grbg'] as const).flatMap((square) => [
    [`bayer_${square}8`, bayer(square, 1)] as const,
    [`bayer_${square}16`, bayer(square, 2)] as const,
  ]),
]);

/** A picture, row by row. */
export interface ImageRows {
  width: number;
  height: number;
  /** @param into R, G, B, 255 of each pixel: 4 × width bytes */
  readRow(row: number, into: Uint8Array): void;
}

/**
 * Checks an image and returns its rows; its data is read on demand.
 *
 * @throws {RosFault} `bad-image`, `unsupported`, `too-large`
 */
export function pictureRows(image: Image): ImageRows {
  const { width, height, encoding, data } = image;
  const found = ENCODINGS.get(encoding);
  if (found === undefined) {
    throw new RosFault('unsupported', `a picture as ${encoding || 'nothing'}`, {
      remedy: `the encodings are ${[...ENCODINGS.keys()].join(', ')}`,
    });
  }
  if (checkedPixels(image, found.bytes, MOST_PICTURE_PIXELS) === 0)
    throw new RosFault('bad-image', `${width} × ${height} pixels`);
  const { even, read } = found;
  if ((even !== undefined && width % 2 === 1) || (even === 'both' && height % 2 === 1))
    throw new RosFault('bad-image', `${width} × ${height} pixels as ${encoding}, whose sides are even`);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  return { width, height, readRow: (row, into) => read(image, view, row, into) };
}

function clamp(value: number): number {
  return value < 0 ? 0 : value > 255 ? 255 : Math.round(value);
}
