/** Loads the WASM module in Node, from the file in this package. */
import { readFile } from 'node:fs/promises';
import { type Codec, loadCodec } from './codec.ts';

/** @throws CodecError `not-loadable` */
export function loadCodecFromDisk(): Promise<Codec> {
  return loadCodec(readFile(new URL('../pkg/farpoint_codec_bg.wasm', import.meta.url)));
}
