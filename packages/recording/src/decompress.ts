/** The compressions of MCAP and of ROS 1 bags. */
import { zstdDecompressSync } from 'node:zlib';
import Bzip2 from '@foxglove/wasm-bz2';
import lz4 from '@foxglove/wasm-lz4';
import { RecordingError } from './errors.ts';
import { MAX_RECORD_BYTES } from './file-bytes.ts';

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

const lz4Decompress = bounded((compressed, size) => lz4(compressed, size));
const zstdDecompress = bounded((compressed, size) =>
  zstdDecompressSync(compressed, { maxOutputLength: size }),
);
let bzip2: Promise<Bzip2> | null = null;

/** By the names that MCAP uses. */
export async function mcapDecompressors(): Promise<{ lz4: Decompress; zstd: Decompress }> {
  await lz4.isLoaded;
  return { lz4: lz4Decompress, zstd: zstdDecompress };
}

/** By the names that bags use. */
export async function bagDecompressors(): Promise<{ lz4: Decompress; bz2: Decompress }> {
  bzip2 ??= Bzip2.init();
  const [loaded] = await Promise.all([bzip2, lz4.isLoaded]);
  return { lz4: lz4Decompress, bz2: bounded((compressed, size) => loaded.decompress(compressed, size)) };
}
