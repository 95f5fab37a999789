/** JPEG written and read, PNG read: the WASM module's functions, with typed faults. */
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

/** There may be one in a thread. */
export class PictureCodec {
  /** A decoder that trapped leaves memory behind: whoever sees this goes on in a new thread. */
  trapped = false;

  private constructor() {}

  static async load(): Promise<PictureCodec> {
    const file = new URL('../wasm/farpoint_picture_codec_bg.wasm', import.meta.url);
    initSync({ module: await readFile(file) });
    return new PictureCodec();
  }

  /**
   * A baseline JPEG with half the colour resolution.
   *
   * @param pixels alpha is passed over
   * @param quality 1–100
   * @throws {PictureCodecError} where the sizes do not agree
   */
  encodeJpeg({ width, height, rgba }: Readonly<PicturePixels>, quality: number): Uint8Array<ArrayBuffer> {
    return this.#call(() => encode_jpeg(rgba, width, height, quality) as Uint8Array<ArrayBuffer>);
  }

  /**
   * @param mostPixels a picture that says it has more is refused before it is read
   * @throws {PictureCodecError} where it is broken, too large, or not of that format
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
      // What the module refuses comes as text; anything else is a trap.
      if (typeof error === 'string') throw new PictureCodecError(error);
      this.trapped = true;
      throw new PictureCodecError('the decoder gave up', { cause: error });
    }
  }
}
