import { expect, test } from 'vitest';
import { emptyRtpHeader, readRtpHeader } from './rtp-header.ts';
import { RtpHeaderTemplate } from './rtp-header-template.ts';

test('the reader reads back what it writes, packet after packet', () => {
  const template = new RtpHeaderTemplate({
    payloadType: 111,
    ssrc: 0xdeadbeef,
    mid: 'cloud',
    midExtensionId: 2,
    transportSequenceExtensionId: 5,
  });
  const header = emptyRtpHeader();
  for (const [marker, sequence, timestamp, transportSequence] of [
    [false, 0, 0, 0xffff],
    [true, 0xfffe, 0xfffffffe, 0x1234],
  ] as const) {
    template.patch(marker, sequence, timestamp, transportSequence);
    expect(readRtpHeader(template.bytes, 5, header)).toBe(true);
    expect(header).toEqual({
      ...{ bytes: template.bytes.length, payloadType: 111, ssrc: 0xdeadbeef },
      ...{ sequence, transportSequence },
    });
    expect(template.bytes[1]! >> 7).toBe(marker ? 1 : 0);
    expect(new DataView(template.bytes.buffer).getUint32(4)).toBe(timestamp);
  }
  expect(String.fromCharCode(...template.bytes)).toContain('cloud');
});

test.each(['', 'a-mid-that-is-too-long', 'ä'])('refuses the mid “%s”', (mid) => {
  expect(() => new RtpHeaderTemplate({ payloadType: 111, ssrc: 1, mid })).toThrow(RangeError);
});
