import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { packetiseH264 } from './h264-payload.ts';
import { annexB, anyUnits, PPS, SPS, slice } from './testing/pictures.ts';
import { VideoDepacketiser } from './video-depacketiser.ts';
import { VideoPayloadError } from './video-payload-error.ts';

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const KEY_FRAME = hex('00000001 6742c01f 00000001 28ce3c80 000001 65888421a0');

function payloadsOf(accessUnit: Uint8Array, max: number): string[] {
  return packetiseH264(accessUnit, max).map((payload) => Buffer.from(payload).toString('hex'));
}

function reasonOf(accessUnit: Uint8Array, max: number): string | null {
  try {
    packetiseH264(accessUnit, max);
    return null;
  } catch (error) {
    if (error instanceof VideoPayloadError) return error.reason;
    throw error;
  }
}

describe('packetiseH264', () => {
  it('parameter sets share a STAP-A, with the highest importance; the slice is by itself', () => {
    expect(payloadsOf(KEY_FRAME, 13)).toEqual(['7800046742c01f000428ce3c80', '65888421a0']);
  });

  it('what does not fit into the STAP-A follows it, and what is alone needs none', () => {
    expect(payloadsOf(KEY_FRAME, 12)).toEqual(['6742c01f', '28ce3c80', '65888421a0']);
    const delimited = hex('000001 0910 000001 6742c01f 000001 28ce3c80 000001 060105 000001 65888421a0');
    expect(payloadsOf(delimited, 12)).toEqual([
      '780002091000046742c01f',
      '38000428ce3c800003060105',
      '65888421a0',
    ]);
  });

  it('a NAL unit longer than the limit becomes FU-As: start, middle, end', () => {
    expect(payloadsOf(hex('000001 65888421a0b1'), 4)).toEqual(['7c858884', '7c0521a0', '7c45b1']);
    expect(payloadsOf(KEY_FRAME, 4)).toEqual(['6742c01f', '28ce3c80', '7c858884', '7c4521a0']);
  });

  it('SEI behind a slice stays behind it, by itself', () => {
    expect(payloadsOf(hex('000001 4188 000001 0601 000001 0602'), 100)).toEqual(['4188', '0601', '0602']);
  });

  it('refuses what has no payloads, with the reason', () => {
    expect(reasonOf(new Uint8Array(0), 1200)).toBe('empty');
    expect(reasonOf(hex('00000004 65888421'), 1200)).toBe('no-nal-unit');
    expect(reasonOf(hex('00000001 000001'), 1200)).toBe('no-nal-unit');
    for (const type of ['60', '78', '7c', '7f'])
      expect(reasonOf(hex(`000001 ${type}88`), 1200)).toBe('bad-nal-unit');
    for (const max of [2, 0, -1, 3.5, Number.NaN, Number.POSITIVE_INFINITY])
      expect(reasonOf(KEY_FRAME, max)).toBe('limit-too-small');
    expect(reasonOf(KEY_FRAME, 3)).toBeNull();
  });

  it('fills one buffer', () => {
    const payloads = packetiseH264(annexB([SPS, PPS, slice(true, 5000)]), 1100);
    expect(new Set(payloads.map(({ buffer }) => buffer)).size).toBe(1);
    expect(payloads).toHaveLength(6);
  });

  it('any NAL units come back, from payloads within the limit', () => {
    const limit = fc.oneof(fc.integer({ min: 3, max: 12 }), fc.integer({ min: 13, max: 300 }));
    const sample = limit.chain((max) => fc.tuple(fc.constant(max), anyUnits(max), fc.constantFrom(3, 4)));
    fc.assert(
      fc.property(sample, ([max, units, startCode]) => {
        const payloads = packetiseH264(annexB(units, [startCode]), max);
        expect(Math.max(...payloads.map((payload) => payload.length))).toBeLessThanOrEqual(max);
        const depacketiser = new VideoDepacketiser('h264');
        // A whole frame before it: the first one of a stream must begin with its first packet.
        expect(depacketiser.take(9, 0, true, SPS)).not.toBeNull();
        const frames = payloads.map((payload, i) =>
          depacketiser.take(10 + i, 3000, i === payloads.length - 1, payload),
        );
        expect(frames.pop()?.bytes).toEqual(annexB(units));
        expect(frames.every((frame) => frame === null)).toBe(true);
      }),
      { seed: 3, numRuns: 1500 },
    );
  });
});
