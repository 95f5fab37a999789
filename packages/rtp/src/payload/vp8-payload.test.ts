import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { vp8Frame } from './testing/pictures.ts';
import { VideoDepacketiser } from './video-depacketiser.ts';
import { VideoPayloadError } from './video-payload-error.ts';
import { emptyVp8Descriptor, readVp8Descriptor } from './vp8-descriptor.ts';
import { isVp8KeyFrame, readVp8FrameHeader, vp8KeyFrameSize } from './vp8-frame-header.ts';
import { packetiseVp8 } from './vp8-payload.ts';

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));

function reasonOf(frame: Uint8Array, max: number): string | null {
  try {
    packetiseVp8(frame, 0, max);
    return null;
  } catch (error) {
    if (error instanceof VideoPayloadError) return error.reason;
    throw error;
  }
}

describe('packetiseVp8', () => {
  const payloadsOf = (frame: Uint8Array, id: number, max: number) =>
    packetiseVp8(frame, id, max).map((payload) => Buffer.from(payload).toString('hex'));

  it('puts X, I, M and the picture id in front of each piece, and S in front of the first', () => {
    expect(payloadsOf(hex('0102030405'), 0x1234, 6)).toEqual(['908092340102', '808092340304', '8080923405']);
    expect(payloadsOf(hex('0102'), 0x7fff, 6)).toEqual(['9080ffff0102']);
  });

  it('the picture id wraps after 15 bits', () => {
    expect(payloadsOf(hex('01'), 0x8001, 6)).toEqual(['9080800101']);
  });

  it('refuses what has no payloads, with the reason', () => {
    expect(reasonOf(new Uint8Array(0), 1200)).toBe('empty');
    for (const max of [4, 0, -7, 5.5, Number.NaN]) expect(reasonOf(hex('01'), max)).toBe('limit-too-small');
    expect(reasonOf(hex('0102'), 5)).toBeNull();
  });

  it('any frame comes back, from payloads within the limit', () => {
    fc.assert(
      fc.property(fc.integer({ min: 5, max: 60 }), fc.nat(400), fc.nat(0xffff), (max, bytes, id) => {
        const frame = vp8Frame({ width: 320, height: 240 }, bytes);
        const payloads = packetiseVp8(frame, id, max);
        expect(Math.max(...payloads.map((payload) => payload.length))).toBeLessThanOrEqual(max);
        const depacketiser = new VideoDepacketiser('vp8', { waitForKeyFrame: true });
        const frames = payloads.map((payload, i) =>
          depacketiser.take(i, 7, i === payloads.length - 1, payload),
        );
        expect(frames.pop()).toEqual({ timestamp: 7, isKeyFrame: true, bytes: frame });
        expect(frames.every((each) => each === null)).toBe(true);
      }),
      { seed: 4, numRuns: 500 },
    );
  });
});

describe('readVp8Descriptor', () => {
  it.each<[string, string, number, boolean, number]>([
    ['no extension', '10ff', 1, true, -1],
    ['a later partition', '13ff', 1, false, -1],
    ['a continuation', '00ff', 1, false, -1],
    ['non-reference frame', '30ff', 1, true, -1],
    ['7-bit picture id', '908011ff', 3, true, 0x11],
    ['15-bit picture id', '90809234ff', 4, true, 0x1234],
    ['TL0PICIDX', '904055ff', 3, true, -1],
    ['temporal layer', '902055ff', 3, true, -1],
    ['key index', '901055ff', 3, true, -1],
    ['everything', '90f092345566ff', 6, true, 0x1234],
  ])('%s', (_name, text, bytes, beginsFrame, pictureId) => {
    const into = emptyVp8Descriptor();
    expect(readVp8Descriptor(hex(text), into)).toBe(true);
    expect(into).toEqual({ bytes, beginsFrame, pictureId });
    expect(readVp8Descriptor(hex(text).subarray(0, -1), into)).toBe(false);
    expect(readVp8Descriptor(hex(text).subarray(0, -2), into)).toBe(false);
  });
});

describe('readVp8FrameHeader', () => {
  it('reads a key frame’s size without the scaling bits', () => {
    // Frame tag: key frame, version 0, shown, first partition of 1 byte. 640×480, with scaling 1 and 2.
    const frame = hex('300000 9d012a 8042 e081 00');
    expect(readVp8FrameHeader(frame)).toEqual({ isKeyFrame: true, size: { width: 640, height: 480 } });
    expect(isVp8KeyFrame(frame)).toBe(true);
    expect(vp8KeyFrameSize(frame)).toEqual({ width: 640, height: 480 });
  });

  it('an interframe has no size', () => {
    expect(readVp8FrameHeader(hex('310000 aa'))).toEqual({ isKeyFrame: false, size: null });
    expect(vp8KeyFrameSize(hex('310000 aa'))).toBeNull();
  });

  it.each([
    ['too short for a frame tag', '3100'],
    ['a key frame that ends inside its size', '300000 9d012a 8042 e0'],
    ['a wrong start code', '300000 9d012b 8042 e081 00'],
    ['a first partition longer than the frame', '510000 aa'],
  ])('refuses %s', (_name, text) => {
    expect(readVp8FrameHeader(hex(text))).toBeNull();
    expect(isVp8KeyFrame(hex(text))).toBe(false);
  });
});
