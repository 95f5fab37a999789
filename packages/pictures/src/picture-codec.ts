/** Encodes and decodes JPEG, decodes PNG: the WASM module's functions, with typed errors. */
import { readFile } from 'node:fs/promises';
import { decode_jpeg, decode_png, encode_jpeg, initSync } from '../wasm/farpoint_picture_codec.js';

/** A picture that cannot be read or written. */
export class PictureCodecError extends Error {
  override readonly name = 'PictureCodecError';
}

export interface PicturePixels {
  width: number;
  height: number;
  /** R, G, B, 255 of each pixel, row by row. */
  rgba: Uint8Array;
}

/** Use one per thread. */
export class PictureCodec {
  /** A decoder that trapped leaks memory: continue in a new thread. */
  trapped = false;

  private constructor() {}

  static async load(): Promise<PictureCodec> {
    const file = new URL('../wasm/farpoint_picture_codec_bg.wasm', import.meta.url);
    initSync({ module: await readFile(file) });
    return new PictureCodec();
  }

  /**
   * Encodes a baseline JPEG with half the colour resolution.
   *
   * @param pixels alpha is ignored
   * @param quality 1–100
   * @throws {PictureCodecError} if the sizes are inconsistent
   */
  encodeJpeg({ width, height, rgba }: Readonly<PicturePixels>, quality: number): Uint8Array<ArrayBuffer> {
    return this.#call(() => encode_jpeg(rgba, width, height, quality) as Uint8Array<ArrayBuffer>);
  }

  /**
   * @param mostPixels a picture that claims more is refused before it is decoded
   * @throws {PictureCodecError} if it is broken, too large, or not in that format
   */
  decode(format: 'jpeg' | 'png', bytes: Uint8Array, mostPixels: number): PicturePixels {
    return this.#call(() => {
      const pixels = (format === 'jpeg' ? decode_jpeg : decode_png)(bytes, mostPixels);
      try {
        return { width: pixels.width, height: pixels.height, rgba: pixels.take() };
      } finally {
        pixels.free();
      }
    });
  }

  #call<T>(act: () => T): T {
    try {
      return act();
    } catch (error) {
      // The module's own errors are text; anything else is a trap.
      if (typeof error === 'string') throw new PictureCodecError(error);
      this.trapped = true;
      throw new PictureCodecError('the decoder gave up', { cause: error });
    }
  }
}
