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

test('carries the capture time beside the other extensions', () => {
  const ids = { midExtensionId: 1, transportSequenceExtensionId: 2, captureTimeExtensionId: 3 };
  const template = new RtpHeaderTemplate({ payloadType: 96, ssrc: 1, mid: '12', ...ids });
  expect(template.hasCaptureTime).toBe(true);
  template.patchCaptureTime({ seconds: 0xe0000001, fraction: 0x80000000 });
  template.patch(true, 7, 9, 0x0102);
  // Three words of header, one of the extension's, then the elements in 15 bytes, padded to 16.
  expect([...template.bytes.subarray(12)]).toEqual([
    ...[0xbe, 0xde, 0, 4],
    ...[0x21, 0x01, 0x02],
    ...[0x11, 0x31, 0x32],
    ...[0x37, 0xe0, 0, 0, 1, 0x80, 0, 0, 0],
    0,
  ]);
});

test('without the capture time’s extension, a time changes nothing', () => {
  const template = new RtpHeaderTemplate({ payloadType: 96, ssrc: 1, mid: '1' });
  const before = [...template.bytes];
  template.patchCaptureTime({ seconds: 1, fraction: 2 });
  expect([...template.bytes]).toEqual(before);
  expect(template.hasCaptureTime).toBe(false);
});

test.each(['', 'a-mid-that-is-too-long', 'ä'])('refuses the mid “%s”', (mid) => {
  expect(() => new RtpHeaderTemplate({ payloadType: 111, ssrc: 1, mid })).toThrow(RangeError);
});
