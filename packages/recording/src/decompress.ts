/** The compression methods of MCAP and of ROS 1 bags. */
import { zstdDecompressSync } from 'node:zlib';
import Bzip2 from '@foxglove/wasm-bz2';
import { RecordingError } from './errors.ts';
import { MAX_RECORD_BYTES } from './file-bytes.ts';
import { decompressLz4 } from './lz4.ts';

export type Decompress = (compressed: Uint8Array, size: number | bigint) => Uint8Array;

function bounded(decompress: (compressed: Uint8Array, size: number) => Uint8Array): Decompress {
  return (compressed, size) => {
    const bytes = Number(size);
    if (bytes > MAX_RECORD_BYTES)
      throw new RecordingError('too-large', `a chunk of ${bytes} bytes, unpacked`);
    if (bytes === 0) return new Uint8Array(0);
    const unpacked = decompress(compressed, bytes);
    if (unpacked.byteLength !== bytes) {
      throw new RecordingError('damaged', `a chunk unpacks to ${unpacked.byteLength} bytes, not ${bytes}`);
    }
    return unpacked;
  };
}

const lz4 = bounded(decompressLz4);
const zstd = bounded((compressed, size) => zstdDecompressSync(compressed, { maxOutputLength: size }));
let bzip2: Promise<Bzip2> | null = null;

/** By the names used in MCAP. */
export const mcapDecompressors: { lz4: Decompress; zstd: Decompress } = { lz4, zstd };

/** By the names used in bags. */
export async function bagDecompressors(): Promise<{ lz4: Decompress; bz2: Decompress }> {
  bzip2 ??= Bzip2.init();
  const loaded = await bzip2;
  return { lz4, bz2: bounded((compressed, size) => loaded.decompress(compressed, size)) };
}
