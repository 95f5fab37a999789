/** Colours of points whose red, green and blue are fields of their own, as numbers of any type. */
import type { PointCloud2, PointField } from './messages.ts';
import { FLOAT32, FLOAT64, typeOf, UINT8 } from './point-field.ts';
import { forEachPoint, type Rows } from './point-words.ts';

const WHOLE_SCALES = [255, 65_535, 4_294_967_295];
const FLOAT_SCALES = [1, ...WHOLE_SCALES];

/** Red, green and blue. */
export type Channels = readonly [PointField, PointField, PointField];

export class ColourChannels {
  /** What full red is. Like that of all clouds so far: a scale that changed to and fro would make everything flicker. */
  #scale = 0;

  /**
   * Bytes count as they are. Other types do not say what full red is: it is the least of 1 (floats only), 255, 65,535
   * and 2^32 − 1 that no value so far exceeds.
   *
   * @param stride words from one point's colour to the next, the first at `first`
   */
  paint(
    { data, is_bigendian }: PointCloud2,
    rows: Rows,
    channels: Channels,
    words: Uint32Array,
    stride: number,
    first: number,
  ): void {
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    const [r, g, b] = channels.map(({ offset }) => offset) as [number, number, number];
    if (channels.every(({ datatype }) => datatype === UINT8)) {
      forEachPoint(rows, (at, i) => {
        words[i * stride + first] =
          view.getUint8(at + r) | (view.getUint8(at + g) << 8) | (view.getUint8(at + b) << 16) | 0xff00_0000;
      });
      return;
    }
    const little = !is_bigendian;
    const [readR, readG, readB] = channels.map((field) => typeOf(field).read) as [Read, Read, Read];
    let most = 0;
    forEachPoint(rows, (at) => {
      const [red, green, blue] = [
        readR(view, at + r, little),
        readG(view, at + g, little),
        readB(view, at + b, little),
      ];
      // NaN and infinity fail the comparison.
      for (const each of [red, green, blue]) if (each > most && each < Number.POSITIVE_INFINITY) most = each;
    });
    const isFloat = channels.some(({ datatype }) => datatype === FLOAT32 || datatype === FLOAT64);
    const scales = isFloat ? FLOAT_SCALES : WHOLE_SCALES;
    this.#scale = Math.max(this.#scale, scales.find((scale) => most <= scale) ?? most);
    const share = 255 / this.#scale;
    forEachPoint(rows, (at, i) => {
      words[i * stride + first] =
        byteOf(readR(view, at + r, little) * share) |
        (byteOf(readG(view, at + g, little) * share) << 8) |
        (byteOf(readB(view, at + b, little) * share) << 16) |
        0xff00_0000;
    });
  }
}

type Read = ReturnType<typeof typeOf>['read'];

/** NaN is 0. */
function byteOf(level: number): number {
  return level > 0 ? Math.min(Math.round(level), 255) : 0;
}
