import { intensityColour, intensityScale } from '@farpoint/cloud-formats';
import { type Channels, ColourChannels } from './colour-channels.ts';
import { RosFault } from './fault.ts';
import { GREY } from './image.ts';
import type { PointCloud2, PointField } from './messages.ts';
import { FLOAT32, fieldReader, readableField, requireFit, rowBytesOf, typeOf } from './point-field.ts';
import {
  alignedWords,
  type CloudAxes,
  copyColours,
  copyPoints,
  copyWords,
  forEachPoint,
  type Rows,
} from './point-words.ts';
import { RingFinder } from './ring-finder.ts';

const LEVELS = 256;

/** Decodes the clouds of one topic. */
export class PointCloud2Decoder {
  readonly #palette = Uint32Array.from({ length: LEVELS }, (_, i) => intensityColour(i / (LEVELS - 1)));
  /** Taken from the first cloud with intensities: a changing scale would make everything flicker. */
  #intensityScale: number | null = null;
  readonly #channels = new ColourChannels();
  readonly #rings = new RingFinder();

  /** Elevations of the LiDAR's rings, radians, ascending; `null` until clouds have told them. */
  get rings(): readonly number[] | null {
    return this.#rings.elevations;
  }

  /**
   * Accepts fields of any layout, type and endianness: x, y and z; colour from `rgb`, `rgba`, or `r`, `g`, `b`; else
   * from `intensity`; else grey. Fields that are not read, and colours that cannot be, do no harm.
   *
   * @param into four words per point: x, y, z in metres in the optical frame, then the bytes R, G, B, A
   * @returns the number of points
   * @throws {RosFault} `bad-cloud`, `too-large`
   */
  decode(cloud: PointCloud2, axes: CloudAxes, into: Float32Array): number {
    const { width, height } = cloud;
    const count = checkedCount(cloud);
    if (count * 4 > into.length) {
      throw new RosFault('too-large', `a cloud of ${count} points, room for ${into.length / 4}`);
    }
    if (count === 0) return 0;
    const [x, y, z] = ['x', 'y', 'z'].map((name) => fieldOf(cloud, name)) as [
      PointField,
      PointField,
      PointField,
    ];
    const rowBytes = rowBytesOf(cloud);
    const rows: Rows = { width, height, rowBytes, step: cloud.point_step };
    if (isPlain(cloud, [x, y, z], rowBytes))
      copyPoints(alignedWords(cloud.data), rows, [x, y, z], axes, into);
    else readCoordinates(cloud, rows, [x, y, z], axes, into);
    this.#colour(cloud, rows, new Uint32Array(into.buffer, into.byteOffset, into.length), 4, 3);
    this.#rings.take(cloud, into);
    return count;
  }

  /**
   * Reads a depth camera's cloud as its images: each pixel holds the depth; x and y follow from the camera. The cloud's
   * axes are optical.
   *
   * @param depth along z, metres
   * @param colour R, G, B, A, R lowest
   * @returns the number of pixels
   * @throws {RosFault} `bad-cloud`, `too-large`
   */
  decodeImages(cloud: PointCloud2, depth: Float32Array, colour: Uint32Array): number {
    const count = checkedCount(cloud);
    if (count > depth.length) {
      throw new RosFault('too-large', `a cloud of ${count} points, room for ${depth.length}`);
    }
    if (count === 0) return 0;
    const { width, height } = cloud;
    const rowBytes = rowBytesOf(cloud);
    const rows: Rows = { width, height, rowBytes, step: cloud.point_step };
    const z = fieldOf(cloud, 'z');
    const { data } = cloud;
    if (isPlain(cloud, [z], rowBytes)) {
      copyWords(alignedWords(data), rows, z.offset >> 2, depth);
    } else {
      const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
      const little = !cloud.is_bigendian;
      const { read } = typeOf(z);
      forEachPoint(rows, (at, i) => {
        depth[i] = read(view, at + z.offset, little);
      });
    }
    this.#colour(cloud, rows, colour, 1, 0);
    return count;
  }

  /** @param stride words from one point's colour to the next, the first at `first` */
  #colour(cloud: PointCloud2, rows: Rows, words: Uint32Array, stride: number, first: number): void {
    const { data } = cloud;
    const little = !cloud.is_bigendian;
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    const named = (...names: string[]) => readableField(cloud, ...names);
    const packed = named('rgb', 'rgba');
    if (packed !== undefined && packed.offset + 4 <= cloud.point_step) {
      // Read as words: the bits are the same, whatever the field's type says.
      const plain = { ...packed, datatype: FLOAT32 };
      if (data.byteOffset % 4 === 0 && isPlain(cloud, [plain], rows.rowBytes)) {
        const source = new Uint32Array(data.buffer, data.byteOffset, data.length >> 2);
        copyColours(source, rows, packed.offset >> 2, words, stride, first);
        return;
      }
      forEachPoint(rows, (at, i) => {
        const argb = view.getUint32(at + packed.offset, little);
        words[i * stride + first] =
          ((argb >> 16) & 0xff) | (argb & 0xff00) | ((argb & 0xff) << 16) | 0xff00_0000;
      });
      return;
    }
    const channels = [named('r', 'red'), named('g', 'green'), named('b', 'blue')];
    if (channels.every((field) => field !== undefined)) {
      this.#channels.paint(cloud, rows, channels as unknown as Channels, words, stride, first);
      return;
    }
    const intensity = named('intensity', 'intensities', 'reflectivity');
    if (intensity === undefined) {
      forEachPoint(rows, (_, i) => {
        words[i * stride + first] = GREY;
      });
      return;
    }
    const { read } = typeOf(intensity);
    const intensityAt = fieldReader(cloud, intensity);
    this.#intensityScale ??= intensityScale(intensityAt, rows.width * rows.height);
    const scale = this.#intensityScale * (LEVELS - 1);
    const palette = this.#palette;
    forEachPoint(rows, (at, i) => {
      const level = read(view, at + intensity.offset, little) * scale;
      // NaN fails the comparison.
      const index = level > 0 ? Math.min(Math.round(level), LEVELS - 1) : 0;
      words[i * stride + first] = palette[index] as number;
    });
  }
}

/** Checks that the points can be read, and that the data is as long as they require. @returns width × height */
export function checkedCount(cloud: PointCloud2): number {
  const { width, height, point_step, row_step, data } = cloud;
  const count = width * height;
  if (count === 0) return 0;
  for (const name of ['x', 'y', 'z']) {
    const field = cloud.fields.find((each) => each.name === name);
    if (field !== undefined) requireFit(cloud, field, typeOf(field).bytes);
  }
  if (height > 1 && row_step > 0 && row_step < width * point_step)
    throw new RosFault('bad-cloud', `a row of ${row_step} bytes for ${width} points of ${point_step}`);
  const needed = (height - 1) * rowBytesOf(cloud) + width * point_step;
  if (data.length < needed) {
    throw new RosFault('bad-cloud', `the data ends, ${needed} bytes expected`, { offset: data.length });
  }
  return count;
}

function fieldOf({ fields }: PointCloud2, name: string): PointField {
  const field = fields.find((each) => each.name === name);
  if (field === undefined) {
    throw new RosFault('bad-cloud', `no field ${name}, but ${fields.map((each) => each.name).join(', ')}`);
  }
  return field;
}

/** Little-endian floats at multiples of four, as nearly every driver writes them. */
function isPlain(cloud: PointCloud2, xyz: readonly PointField[], rowBytes: number): boolean {
  return (
    !cloud.is_bigendian &&
    cloud.point_step % 4 === 0 &&
    rowBytes % 4 === 0 &&
    xyz.every((field) => field.datatype === FLOAT32 && field.offset % 4 === 0)
  );
}

function readCoordinates(
  { data, is_bigendian }: PointCloud2,
  rows: Rows,
  [x, y, z]: readonly [PointField, PointField, PointField],
  axes: CloudAxes,
  into: Float32Array,
): void {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const [readX, readY, readZ] = [typeOf(x).read, typeOf(y).read, typeOf(z).read];
  const little = !is_bigendian;
  forEachPoint(rows, (at, i) => {
    const forward = readX(view, at + x.offset, little);
    const left = readY(view, at + y.offset, little);
    const up = readZ(view, at + z.offset, little);
    into[i * 4] = axes === 'optical' ? forward : -left;
    into[i * 4 + 1] = axes === 'optical' ? left : -up;
    into[i * 4 + 2] = axes === 'optical' ? up : forward;
  });
}

/** Optical frames are recognised by their names, according to REP-103. */
export function axesOf(frameId: string): CloudAxes {
  return frameId.includes('optical') ? 'optical' : 'body';
}
