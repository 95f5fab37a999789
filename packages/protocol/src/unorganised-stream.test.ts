import { expect, test } from 'vitest';
import { ProtocolError } from './errors.ts';
import { decodeUnorganisedStream, encodeUnorganisedStream } from './unorganised-stream.ts';

test('encodes and decodes the format’s eight-byte header', () => {
  const bytes = encodeUnorganisedStream({ unitMm: 0x0210 });
  expect([...bytes]).toEqual([0x46, 0x50, 0x55, 0x43, 1, 0, 0x10, 0x02]);
  expect(decodeUnorganisedStream(bytes)).toEqual({ unitMm: 0x0210 });
});

test.each([
  ['nothing', [], 'too-short'],
  ['a byte short', [0x46, 0x50, 0x55, 0x43, 1, 0, 1], 'too-short'],
  ['a byte too many', [0x46, 0x50, 0x55, 0x43, 1, 0, 1, 0, 0], 'too-large'],
  ['another magic', [0x46, 0x50, 0x4f, 0x43, 1, 0, 1, 0], 'invalid'],
  ['another version', [0x46, 0x50, 0x55, 0x43, 2, 0, 1, 0], 'invalid'],
  ['no unit', [0x46, 0x50, 0x55, 0x43, 1, 0, 0, 0], 'invalid'],
])('refuses %s', (_, bytes, code) => {
  const decode = () => decodeUnorganisedStream(Uint8Array.from(bytes));
  expect(decode).toThrow(ProtocolError);
  expect(decode).toThrow(expect.objectContaining({ code }));
});
