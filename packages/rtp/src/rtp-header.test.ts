import { expect, it } from 'vitest';
import { emptyRtpHeader, readRtpHeader } from './rtp-header.ts';

const read = (hex: string, id = 1) => {
  const header = emptyRtpHeader();
  return readRtpHeader(Buffer.from(hex, 'hex'), id, header) ? header : null;
};

it('reads the reference profile’s 20 bytes', () => {
  expect(read('9085fffe00000001deadbeefbede00011112340055')).toEqual({
    bytes: 20,
    payloadType: 5,
    sequence: 0xfffe,
    ssrc: 0xdeadbeef,
    transportSequence: 0x1234,
  });
});

it('finds the extension among others, works without it, and reads nothing beyond the end', () => {
  // Contributing source, padding, another element before it.
  expect(read('91050001000000010000000200000003bede0002210000001012340000')).toMatchObject({
    bytes: 28,
    transportSequence: -1,
  });
  expect(read('900500010000000100000002bede00022100001156780000')).toMatchObject({
    bytes: 24,
    transportSequence: 0x5678,
  });
  expect(read('800500010000000100000002')).toMatchObject({ bytes: 12, transportSequence: -1 });
  expect(read('900500010000000100000002bede000211')).toBeNull();
  expect(read('9005000100000001000000')).toBeNull();
  expect(read('400500010000000100000002')).toBeNull();
  // An element that claims more than the extension holds.
  expect(read('900500010000000100000002bede00011f123400')).toMatchObject({
    bytes: 20,
    transportSequence: -1,
  });
});
