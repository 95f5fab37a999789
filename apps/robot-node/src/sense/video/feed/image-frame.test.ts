import { RosFault } from '@farpoint/ros';
import { rawFrameBytes } from '@farpoint/video';
import { describe, expect, it } from 'vitest';
import { imageFrame } from './ros-video-feed.ts';

const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };
const room = (bytes: number) => new Uint8Array(bytes).fill(0xee);

function image(encoding: string, width: number, height: number, step: number, bytes = step * height) {
  const data = Uint8Array.from({ length: bytes }, (_, i) => i & 255);
  return { header, encoding, width, height, step, is_bigendian: false, data };
}

describe('an image', () => {
  it.each([
    ['rgb8', 'rgb', 3],
    ['bgr8', 'bgr', 3],
    ['8UC3', 'bgr', 3],
    ['rgba8', 'rgba', 4],
    ['bgra8', 'bgra', 4],
    ['8UC4', 'bgra', 4],
    ['mono8', 'gray', 1],
    ['8UC1', 'gray', 1],
    ['yuv422', 'uyvy', 2],
    ['yuv422_yuy2', 'yuy2', 2],
  ] as const)('in %s keeps its bytes as %s', (encoding, format, pixelBytes) => {
    const given = image(encoding, 6, 4, 6 * pixelBytes);
    const frame = imageFrame(given, 5n, room);
    expect(frame).toMatchObject({ captureNs: 5n, format, width: 6, height: 4, stride: 6 * pixelBytes });
    expect(frame.bytes).toEqual(given.data);
    expect(frame.bytes.length).toBe(rawFrameBytes(frame));
  });

  it('with gaps between its rows, the last of which ends early, has none afterwards', () => {
    const given = image('rgb8', 2, 3, 10, 26);
    const { bytes, stride } = imageFrame(given, 0n, room);
    expect(stride).toBe(6);
    expect([...bytes]).toEqual([0, 10, 20].flatMap((at) => [0, 1, 2, 3, 4, 5].map((i) => at + i)));
  });

  it.each(['mono16', '16UC1', 'bayer_rggb8', 'bayer_gbrg16'])('in %s becomes colours', (encoding) => {
    const pixelBytes = encoding === 'bayer_rggb8' ? 1 : 2;
    const frame = imageFrame(image(encoding, 4, 2, 4 * pixelBytes), 0n, room);
    expect(frame).toMatchObject({ format: 'rgba', stride: 16 });
    expect(frame.bytes.length).toBe(32);
    for (let at = 3; at < 32; at += 4) expect(frame.bytes[at]).toBe(255);
  });

  it.each([
    [
      'of an unknown encoding',
      image('rgb12', 4, 2, 12),
      'unsupported',
      /a picture as rgb12; the encodings are/,
    ],
    ['that ends early', image('rgb8', 4, 2, 12, 23), 'bad-image', /the data ends/],
    ['whose rows are too short', image('rgb8', 4, 2, 11), 'bad-image', /a row of 11 bytes/],
    ['without pixels', image('rgb8', 0, 0, 0), 'bad-image', /0 × 0/],
    ['that is too wide', image('mono8', 8193, 1, 8193), 'too-large', /8193 × 1/],
  ] as const)('%s is refused, and says why', (_, given, code, words) => {
    try {
      imageFrame(given, 0n, room);
    } catch (error) {
      expect(error).toBeInstanceOf(RosFault);
      expect(error).toMatchObject({ code, message: expect.stringMatching(words) as string });
      return;
    }
    throw new Error('it was accepted');
  });
});
