/** `points64`, and Zstandard over its bytes. */
import { zstdCompressSync, zstdDecompressSync } from 'node:zlib';
import { bytesOfPoints, MAX_POINT_DATA_BYTES, POINTS_PER_PACKET } from '@farpoint/protocol';
import { CloudDecoder, type Codec, Points64Encoder, packetsFor } from '@farpoint/wasm-codec';
import { type BenchCloud, blobPackets, type CodecRun, type DecodedCloud, write664 } from './adapter.ts';

/** The mandatory format, with all points that it can represent, in their order. */
export function points64(codec: Codec, cloud: BenchCloud): CodecRun {
  const total = cloud.frame.length / 4;
  const encoder = new Points64Encoder(codec, total);
  const decoder = new CloudDecoder(codec, packetsFor(total));
  const words = new Uint32Array(cloud.frame.buffer, cloud.frame.byteOffset, cloud.frame.length);
  encoder.frameBits.set(words);
  let kept = 0;
  let chosen = new Uint32Array(0);
  let decodedPackets: readonly number[] = [];
  let points: Int16Array = new Int16Array(0);
  const bytesOf = (packet: number) =>
    bytesOfPoints(Math.min(POINTS_PER_PACKET, kept - packet * POINTS_PER_PACKET));
  return {
    codec: 'points64',
    setting: '1 mm, 6-6-4',
    blob: false,
    encode() {
      // Equal weights and a budget for all points: nothing is sampled; only points that the format cannot represent
      // are left out.
      ({ kept } = encoder.sample({
        points: total,
        count: total,
        seed: 1,
        lambda: 0,
        depthMeasure: cloud.depth,
      }));
      encoder.pack();
      chosen = encoder.chosen.slice();
    },
    packetBytes: () => Array.from({ length: packetsFor(kept) }, (_, i) => bytesOf(i)),
    decode(packets) {
      decodedPackets = packets;
      const { stride, dataOffset } = encoder.layout;
      for (const packet of packets) {
        const at = packet * stride + dataOffset;
        decoder.put(encoder.packets.subarray(at, at + bytesOf(packet)));
      }
      points = decoder.unpack();
    },
    decoded: () => fromWords(points, cloud, sourcesOf(decodedPackets, chosen)),
    [Symbol.dispose]() {
      encoder[Symbol.dispose]();
      decoder[Symbol.dispose]();
    },
  };
}

/** One Zstandard blob over the `points64` packets. */
export function zstd(codec: Codec, cloud: BenchCloud): CodecRun {
  const inner = new Points64Encoder(codec, cloud.frame.length / 4);
  const words = new Uint32Array(cloud.frame.buffer, cloud.frame.byteOffset, cloud.frame.length);
  inner.frameBits.set(words);
  const total = cloud.frame.length / 4;
  let kept = 0;
  let chosen = new Uint32Array(0);
  let blob: Uint8Array = new Uint8Array(0);
  let plain: Uint8Array = new Uint8Array(0);
  return {
    codec: 'zstd',
    setting: 'over points64',
    blob: true,
    encode() {
      ({ kept } = inner.sample({
        points: total,
        count: total,
        seed: 1,
        lambda: 0,
        depthMeasure: cloud.depth,
      }));
      inner.pack();
      chosen = inner.chosen.slice();
      const { stride, dataOffset } = inner.layout;
      const blocks = new Uint8Array(bytesOfPoints(kept));
      for (let i = 0; i < packetsFor(kept); i++) {
        const bytes = bytesOfPoints(Math.min(POINTS_PER_PACKET, kept - i * POINTS_PER_PACKET));
        const at = i * stride + dataOffset;
        blocks.set(inner.packets.subarray(at, at + bytes), i * MAX_POINT_DATA_BYTES);
      }
      blob = zstdCompressSync(blocks);
    },
    packetBytes: () => blobPackets(blob.length),
    decode() {
      plain = zstdDecompressSync(blob);
    },
    decoded() {
      const view = new DataView(plain.buffer, plain.byteOffset, plain.byteLength);
      const points = new Int16Array(kept * 4);
      for (let first = 0; first < kept; first += POINTS_PER_PACKET) {
        const count = Math.min(POINTS_PER_PACKET, kept - first);
        for (let i = 0; i < count; i++) {
          for (let axis = 0; axis < 3; axis++) {
            points[(first + i) * 4 + axis] = view.getInt16(bytesOfPoints(first) + i * 6 + axis * 2, true);
          }
          points[(first + i) * 4 + 3] = view.getInt16(bytesOfPoints(first) + count * 6 + i * 2, true);
        }
      }
      return fromWords(points, cloud, chosen);
    },
    [Symbol.dispose]() {
      inner[Symbol.dispose]();
    },
  };
}

/** Millimetres and 6-6-4 bits. An intensity was sent as the red of a colour. */
function fromWords(points: Int16Array, cloud: BenchCloud, source: Uint32Array): DecodedCloud {
  const count = points.length / 4;
  const metres = new Float64Array(count * 3);
  const rgb = new Uint8Array(count * 3);
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) metres[i * 3 + axis] = (points[i * 4 + axis] as number) / 1000;
    write664((points[i * 4 + 3] as number) & 0xffff, rgb, i * 3);
    if (cloud.attribute === 'intensity') rgb.fill(rgb[i * 3] as number, i * 3, i * 3 + 3);
  }
  return { points: count, metres, rgb, source };
}

function sourcesOf(packets: readonly number[], chosen: Uint32Array): Uint32Array {
  const parts = packets.map((packet) =>
    chosen.subarray(packet * POINTS_PER_PACKET, (packet + 1) * POINTS_PER_PACKET),
  );
  const sources = new Uint32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    sources.set(part, at);
    at += part.length;
  }
  return sources;
}
