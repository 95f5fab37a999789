import { type Codec, UnorganisedDecoder, UnorganisedEncoder } from '@farpoint/wasm-codec';
import { type BenchCloud, type CodecRun, write565 } from './adapter.ts';
import { nativeUnorganised } from './native.ts';

/** Grid steps that make sense for the sensor, millimetres. */
export function unorganisedSteps(cloud: BenchCloud): readonly number[] {
  return cloud.depth === 'range' ? [2, 5, 10, 20, 50] : [1, 2, 5, 10];
}

export function unorganised(codec: Codec, cloud: BenchCloud, stepMm: number): CodecRun {
  const total = cloud.frame.length / 4;
  const encoder = new UnorganisedEncoder(codec, total);
  const decoder = new UnorganisedDecoder(codec, total);
  const words = new Uint32Array(cloud.frame.buffer, cloud.frame.byteOffset, cloud.frame.length);
  encoder.frameBits.set(words);
  let packets = 0;
  let indices: readonly number[] = [];
  /** For each packet, its first point among those sent, if the frame's order was kept. */
  let firsts: number[] = [];
  const sent = sentPoints(cloud);
  const intensity = cloud.attribute === 'intensity';
  return {
    codec: 'unorganised',
    setting: `${stepMm} mm, ${intensity ? '8-bit intensity' : '5-6-5'}`,
    blob: false,
    native: (rounds) => nativeUnorganised(cloud, stepMm, rounds),
    encode() {
      ({ packets } = encoder.encode({
        points: total,
        stepMm,
        attribute: intensity ? 'intensity8' : 'colour',
      }));
    },
    // Packets are stored in the order in which they were packed, and are sent nearest first.
    settle() {
      const packed = Array.from({ length: packets }, (_, i) => i);
      packed.sort((a, b) => encoder.packet(a).byteOffset - encoder.packet(b).byteOffset);
      firsts = [];
      let first = 0;
      for (const packet of packed) {
        firsts[packet] = first;
        first += encoder.pointsOf(packet);
      }
    },
    packetBytes: () => Array.from({ length: packets }, (_, i) => encoder.packet(i).length),
    decode(wanted) {
      indices = wanted;
      decoder.clear();
      for (const index of wanted) {
        const points = decoder.decode(encoder.packet(index));
        if (typeof points === 'string') throw new Error(`packet ${index}: ${points}`);
      }
    },
    decoded() {
      const { points } = decoder;
      const count = points.length / 4;
      const rgb = new Uint8Array(count * 3);
      for (let i = 0; i < count; i++) {
        const bits = (points[i * 4 + 3] as number) & 0xffff;
        if (intensity) rgb.fill(bits, i * 3, i * 3 + 3);
        else write565(bits, rgb, i * 3);
      }
      const metres = decoder.metres().slice();
      const source = new Uint32Array(count);
      let at = 0;
      for (const index of indices) {
        const first = firsts[index] as number;
        const points = encoder.pointsOf(index);
        source.set(sent.subarray(first, first + points), at);
        at += points;
      }
      // If the encoder has sorted the points, they are matched by position.
      return { points: count, metres, rgb, source: isSource(source, metres, cloud, stepMm) ? source : null };
    },
    [Symbol.dispose]() {
      encoder[Symbol.dispose]();
      decoder[Symbol.dispose]();
    },
  };
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
