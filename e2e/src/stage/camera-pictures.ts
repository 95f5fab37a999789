/** Pictures of cameras, by the robot's own encoder. */
import { PictureCodec } from '@farpoint/pictures';
import type { PictureFile } from '@farpoint/webxr/stage-control';
import type { Rgb } from './stage.ts';

/** Of the files: their colours are those asked for, but for a level or two. */
const QUALITY = 98;

/** Upright bars of equal width, from the left. */
export async function barsPicture(
  width: number,
  height: number,
  colours: readonly Rgb[],
): Promise<PictureFile> {
  const codec = await PictureCodec.load();
  const rgba = new Uint8Array(4 * width * height);
  for (let i = 0; i < width * height; i++) {
    const bar = Math.floor(((i % width) * colours.length) / width);
    rgba.set([...(colours[bar] ?? [0, 0, 0]), 255], 4 * i);
  }
  const file = codec.encodeJpeg({ width, height, rgba }, QUALITY);
  return { format: 'jpeg', width, height, base64: Buffer.from(file).toString('base64') };
}
