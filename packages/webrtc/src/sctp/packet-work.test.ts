import { expect, it } from 'vitest';
import { sctpWork } from './packet-work.ts';

const packet = (...chunks: [type: number, length: number][]) => {
  const bytes = Buffer.alloc(12 + chunks.reduce((sum, [, length]) => sum + ((length + 3) & ~3), 0));
  let at = 12;
  for (const [type, length] of chunks) {
    bytes.writeUInt8(type, at);
    bytes.writeUInt16BE(length, at + 2);
    at += (length + 3) & ~3;
  }
  return bytes;
};

it('counts chunks, however long their data is', () => {
  expect(sctpWork(packet([0, 1100]))).toBe(1);
  expect(sctpWork(packet([0, 17], [0, 18], [3, 16]))).toBe(3);
});

it('counts what acknowledgements, skips and lists of streams or parameters contain', () => {
  for (const type of [1, 2, 3, 4, 5, 6, 9, 130, 192]) expect(sctpWork(packet([type, 1152]))).toBe(19);
});

it('never takes a packet for nothing, nor a length of 0 for an endless one', () => {
  expect(sctpWork(Buffer.alloc(12))).toBe(1);
  expect(sctpWork(Buffer.alloc(24))).toBe(3);
});
