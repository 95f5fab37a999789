import { type Codec, UnorganisedDecoder, UnorganisedEncoder } from '@farpoint/wasm-codec';
import { type BenchCloud, type CodecRun, type DecodedCloud, write565 } from './adapter.ts';
import { nativeUnorganised } from './native.ts';

/** Grid steps that make sense for the sensor, millimetres. */
export function unorganisedSteps(cloud: BenchCloud): readonly number[] {
  return cloud.depth === 'range' ? [2, 5, 10, 20, 50] : [1, 2, 5, 10];
}

export function unorganised(codec: Codec, cloud: BenchCloud, stepMm: number): CodecRun {
  return new UnorganisedRun(codec, cloud, stepMm);
}

class UnorganisedRun implements CodecRun {
  readonly codec = 'unorganised';
  readonly setting: string;
  readonly blob = false;
  readonly #cloud: BenchCloud;
  readonly #stepMm: number;
  /** Points of the cloud. */
  readonly #total: number;
  readonly #intensity: boolean;
  readonly #encoder: UnorganisedEncoder;
  readonly #decoder: UnorganisedDecoder;
  readonly #sent: Uint32Array;
  #packets = 0;
  #indices: readonly number[] = [];
  /** For each packet, its first point among those sent, if the frame's order was kept. */
  #firsts: number[] = [];

  constructor(codec: Codec, cloud: BenchCloud, stepMm: number) {
    this.#cloud = cloud;
    this.#stepMm = stepMm;
    this.#total = cloud.frame.length / 4;
    this.#intensity = cloud.attribute === 'intensity';
    this.setting = `${stepMm} mm, ${this.#intensity ? '8-bit intensity' : '5-6-5'}`;
    this.#encoder = new UnorganisedEncoder(codec, this.#total);
    this.#decoder = new UnorganisedDecoder(codec, this.#total);
    const words = new Uint32Array(cloud.frame.buffer, cloud.frame.byteOffset, cloud.frame.length);
    this.#encoder.frameBits.set(words);
    this.#sent = sentPoints(cloud);
  }

  native(rounds: number) {
    return nativeUnorganised(this.#cloud, this.#stepMm, rounds);
  }

  encode(): void {
    ({ packets: this.#packets } = this.#encoder.encode({
      points: this.#total,
      stepMm: this.#stepMm,
      attribute: this.#intensity ? 'intensity8' : 'colour',
    }));
  }

  /** Packets are stored in the order in which they were packed, and are sent nearest first. */
  settle(): void {
    const encoder = this.#encoder;
    const packed = Array.from({ length: this.#packets }, (_, i) => i);
    packed.sort((a, b) => encoder.packet(a).byteOffset - encoder.packet(b).byteOffset);
    this.#firsts = [];
    let first = 0;
    for (const packet of packed) {
      this.#firsts[packet] = first;
      first += encoder.pointsOf(packet);
    }
  }

  packetBytes(): number[] {
    return Array.from({ length: this.#packets }, (_, i) => this.#encoder.packet(i).length);
  }

  decode(wanted: readonly number[]): void {
    this.#indices = wanted;
    this.#decoder.clear();
    for (const index of wanted) {
      const points = this.#decoder.decode(this.#encoder.packet(index));
      if (typeof points === 'string') throw new Error(`packet ${index}: ${points}`);
    }
  }

  decoded(): DecodedCloud {
    const { points } = this.#decoder;
    const count = points.length / 4;
    const rgb = new Uint8Array(count * 3);
    for (let i = 0; i < count; i++) {
      const bits = (points[i * 4 + 3] as number) & 0xffff;
      if (this.#intensity) rgb.fill(bits, i * 3, i * 3 + 3);
      else write565(bits, rgb, i * 3);
    }
    const metres = this.#decoder.metres().slice();
    const source = this.#sourceOf(count);
    // If the encoder has sorted the points, they are matched by position.
    const isKept = isSource(source, metres, this.#cloud, this.#stepMm);
    return { points: count, metres, rgb, source: isKept ? source : null };
  }

  [Symbol.dispose](): void {
    this.#encoder[Symbol.dispose]();
    this.#decoder[Symbol.dispose]();
  }

  /** Each decoded point's index in the frame, if its order was kept. */
  #sourceOf(count: number): Uint32Array {
    const source = new Uint32Array(count);
    let at = 0;
    for (const index of this.#indices) {
      const first = this.#firsts[index] as number;
      const points = this.#encoder.pointsOf(index);
      source.set(this.#sent.subarray(first, first + points), at);
      at += points;
    }
    return source;
  }
}

function sentPoints(cloud: BenchCloud): Uint32Array {
  const indices = Uint32Array.from({ length: cloud.frame.length / 4 }, (_, i) => i);
  return indices.filter((i) => {
    const point = cloud.frame.subarray(i * 4, i * 4 + 3);
    return point.every((metres) => Math.abs(metres) <= 500);
  });
}

/** Whether all points are at their sources' positions. */
function isSource(source: Uint32Array, metres: Float32Array, cloud: BenchCloud, stepMm: number): boolean {
  return source.every((index, i) =>
    [0, 1, 2].every((axis) => {
      const error = (metres[i * 3 + axis] as number) - (cloud.frame[index * 4 + axis] as number);
      return Math.abs(error) < stepMm / 1000;
    }),
  );
}
