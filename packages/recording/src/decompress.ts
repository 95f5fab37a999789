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

/** By the name that the formats use. */
export async function decompressors(): Promise<{ lz4: Decompress; zstd: Decompress; bz2: Decompress }> {
  const [bzip2] = await Promise.all([Bzip2.init(), lz4.isLoaded]);
  return {
    lz4: bounded((compressed, size) => lz4(compressed, size)),
    zstd: bounded((compressed, size) => zstdDecompressSync(compressed, { maxOutputLength: size })),
    bz2: bounded((compressed, size) => bzip2.decompress(compressed, size, { small: false })),
  };
}
