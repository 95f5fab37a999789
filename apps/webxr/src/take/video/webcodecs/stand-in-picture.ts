/**
 * What the browser's own receiver gets in place of each frame that was taken from it. With nothing at all, it would ask
 * the robot for key frames several times a second; with the frame itself, it would decode each picture a second time.
 */
import type { VideoCodec } from '@farpoint/operator';

/** A black picture of 16 × 16 pixels that needs no other, in each codec: it costs microseconds to decode. */
const PICTURES: Readonly<Record<VideoCodec, Uint8Array<ArrayBuffer>>> = {
  H264: bytesOf(
    '000000016742c015ddec05a830303528000003000800000301e478b17c0000000168ce3c800000000165888406a8930a0003fbf8',
  ),
  VP8: bytesOf('1002009d012a100010000047088585889984880202000c0d6000feffab5080'),
};

/** @returns a buffer that the caller owns */
export function standInPicture(codec: VideoCodec): ArrayBuffer {
  return PICTURES[codec].slice().buffer;
}

function bytesOf(hex: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(hex.match(/../g) ?? [], (pair) => Number.parseInt(pair, 16));
}
