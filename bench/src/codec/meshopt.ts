/** meshoptimizer's vertex codec over int16 coordinates and 6-6-4 colours, 8 bytes per point. */
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import { type BenchCloud, blobPackets, type CodecRun, write664 } from './adapter.ts';

export async function loadMeshopt(): Promise<void> {
  await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready]);
}

/** Call {@link loadMeshopt} first. Points beyond ±32767 steps are not supported: choose the step for the cloud. */
export function meshopt(cloud: BenchCloud, stepMm: number): CodecRun {
  const { valid, frame } = cloud;
  const words = new Int16Array(valid.length * 4);
  const colours = new Uint32Array(frame.buffer, frame.byteOffset, frame.length);
  let blob: Uint8Array = new Uint8Array(0);
  const plain = new Uint8Array(valid.length * 8);
  return {
    codec: 'meshopt',
    setting: `${stepMm} mm, ${cloud.attribute === 'colour' ? '6-6-4' : '8-bit intensity'}`,
    blob: true,
    encode() {
      const scale = 1000 / stepMm;
      for (let i = 0; i < valid.length; i++) {
        const index = (valid[i] as number) * 4;
        for (let axis = 0; axis < 3; axis++) {
          const steps = Math.round((frame[index + axis] as number) * scale);
          words[i * 4 + axis] = Math.min(32_767, Math.max(-32_767, steps));
        }
        const word = colours[index + 3] as number;
        words[i * 4 + 3] =
          cloud.attribute === 'colour'
            ? ((word & 0xfc) << 8) | ((word >> 6) & 0x3f0) | ((word >> 20) & 0xf)
            : word;
      }
      const bytes = new Uint8Array(words.buffer, words.byteOffset, words.byteLength);
      blob = MeshoptEncoder.encodeVertexBuffer(bytes, valid.length, 8);
    },
    packetBytes: () => blobPackets(blob.length),
    decode() {
      MeshoptDecoder.decodeVertexBuffer(plain, valid.length, 8, blob);
    },
    decoded() {
      const points = new Int16Array(plain.buffer);
      const metres = new Float64Array(valid.length * 3);
      const rgb = new Uint8Array(valid.length * 3);
      for (let i = 0; i < valid.length; i++) {
        for (let axis = 0; axis < 3; axis++) {
          metres[i * 3 + axis] = ((points[i * 4 + axis] as number) * stepMm) / 1000;
        }
        const bits = (points[i * 4 + 3] as number) & 0xffff;
        if (cloud.attribute === 'colour') write664(bits, rgb, i * 3);
        else rgb.fill(bits, i * 3, i * 3 + 3);
      }
      return { points: valid.length, metres, rgb, source: valid };
    },
    [Symbol.dispose]() {},
  };
}
