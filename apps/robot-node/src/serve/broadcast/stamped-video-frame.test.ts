import { readCaptureStamp, type VideoCodec } from '@farpoint/protocol';
import { VideoDepacketiser } from '@farpoint/rtp';
import { describe, expect, test } from 'vitest';
import { VideoFrame } from '../../sense/video/video-frame.ts';
import { StampedVideoFrame } from './stamped-video-frame.ts';

const CAPTURED_MS = 86_400_123.456_789;
const startCode = [0, 0, 0, 1];
const slice = (length: number) => [...startCode, 0x65, ...Array.from({ length }, (_, i) => (i % 200) + 7)];
const h264 = (length: number) =>
  Uint8Array.of(...startCode, 0x67, 0x42, 0xc0, 0x1f, ...startCode, 0x68, 0xce, 0x3c, 0x80, ...slice(length));
const vp8 = (length: number) => Uint8Array.of(0x10, 0, 0, 0x9d, 0x01, 0x2a, 64, 0, 48, 0, ...slice(length));

function framed(codec: VideoCodec, bytes: Uint8Array): { plain: VideoFrame; stamped: StampedVideoFrame } {
  const picture = { bytes, key: true, capturedAtMs: CAPTURED_MS, width: 64, height: 48 };
  const plain = new VideoFrame(picture, { video: 1, codec, pictureId: 7, framesPerSecond: 30 });
  return { plain, stamped: new StampedVideoFrame(plain) };
}

describe.each([
  ['H264', h264],
  ['VP8', vp8],
] as const)('%s', (codec, make) => {
  test.each([20, 1170, 5000])('of %i bytes arrives with its capture time', (length) => {
    const { stamped } = framed(codec, make(length));
    const depacketiser = new VideoDepacketiser(codec === 'H264' ? 'h264' : 'vp8');
    let whole: Uint8Array | null = null;
    for (let i = 0; i < stamped.packets; i++) {
      expect(stamped.payload(i).length).toBeLessThanOrEqual(1206);
      whole =
        depacketiser.take(i, stamped.rtpTimestamp, i === stamped.packets - 1, stamped.payload(i))?.bytes ??
        whole;
    }
    expect(Number(readCaptureStamp(whole as Uint8Array, codec)) / 1e6).toBeCloseTo(CAPTURED_MS, 5);
  });

  test('leaves the operators’ packets as they are', () => {
    const { plain, stamped } = framed(codec, make(3000));
    const before = Array.from({ length: plain.packets }, (_, i) =>
      Buffer.from(plain.payload(i)).toString('hex'),
    );
    for (let i = 0; i < stamped.packets; i++) stamped.payload(i);
    const after = Array.from({ length: plain.packets }, (_, i) =>
      Buffer.from(plain.payload(i)).toString('hex'),
    );
    expect(after).toEqual(before);
    expect(stamped.needsPrevious).toBe(plain.needsPrevious);
    expect(stamped.bytes).toBeGreaterThan(plain.bytes);
  });
});
