import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  bytesOfPoints,
  emptyPointPacketHeader,
  MAX_POINTS_PER_FRAME,
  POINT_PACKET_HEADER_BYTES,
  POINT_PACKET_OFFSETS,
  type PointPacketFault,
  type PointPacketHeader,
  packetCountOf,
  pointsOfBytes,
  readPointPacketHeader,
  writePointPacketHeader,
} from './point-packet.ts';
import { readVectors } from './testing/vectors.ts';

interface PayloadVector {
  name: string;
  headerHex: string;
  payloadBytes: number;
  header?: PointPacketHeader;
  fault?: PointPacketFault;
}
const { payloads } = readVectors<{ payloads: PayloadVector[] }>('point-packet');

function payloadOf({ headerHex, payloadBytes }: PayloadVector): DataView {
  const bytes = new Uint8Array(payloadBytes);
  bytes.set(Buffer.from(headerHex, 'hex').subarray(0, payloadBytes));
  return new DataView(bytes.buffer);
}

describe('conformance vectors', () => {
  test.each(payloads)('$name', (vector) => {
    const header = emptyPointPacketHeader();
    expect(readPointPacketHeader(payloadOf(vector), header)).toBe(vector.fault ?? null);
    if (vector.header !== undefined) expect(header).toEqual(vector.header);
  });

  test.each(payloads.filter(({ header }) => header !== undefined))('write: $name', (vector) => {
    const view = new DataView(new ArrayBuffer(20));
    writePointPacketHeader(view, 3, vector.header as PointPacketHeader);
    expect(Buffer.from(view.buffer, 3, 16).toString('hex')).toBe(vector.headerHex);
    expect([view.getUint8(2), view.getUint8(19)]).toEqual([0, 0]);
  });
});

test('the offsets are where the header has its fields', () => {
  const header = { frameNumber: 1, frameLength: 4800, sequenceOffset: 1200, sequenceLength: 800 };
  const view = new DataView(new ArrayBuffer(POINT_PACKET_HEADER_BYTES));
  writePointPacketHeader(view, 0, header);
  const fields = Object.entries(POINT_PACKET_OFFSETS).map(([name, at]) => [name, view.getUint32(at, true)]);
  expect(Object.fromEntries(fields)).toEqual(header);
});

test('points and their bytes', () => {
  expect([0, 1, 150].map(bytesOfPoints)).toEqual([0, 8, 1200]);
  expect([0, 8, 1200].map(pointsOfBytes)).toEqual([0, 1, 150]);
});

test('packets of a frame', () => {
  expect([0, 1, 150, 151, 30_000, 30_001].map(packetCountOf)).toEqual([0, 1, 1, 2, 200, 201]);
});

test('an accepted header is consistent, whatever the bytes', () => {
  const word = fc.oneof(
    { weight: 5, arbitrary: fc.nat(300).map((n) => n * 8) },
    fc.nat(2500),
    fc.integer({ min: 0, max: 0xffffffff }),
    fc.constantFrom(0, 1200, MAX_POINTS_PER_FRAME * 8, 0xfffffff8),
  );
  let accepted = 0;
  fc.assert(
    fc.property(fc.tuple(word, word, word, word), fc.nat(1300), (words, length) => {
      const view = new DataView(new ArrayBuffer(length));
      words.forEach((value, i) => {
        if (i * 4 + 4 <= length) view.setUint32(i * 4, value, true);
      });
      const header = emptyPointPacketHeader();
      if (readPointPacketHeader(view, header) !== null) return;
      accepted++;
      expect(header.sequenceLength).toBeGreaterThan(0);
      expect(header.sequenceLength).toBeLessThanOrEqual(1200);
      expect(16 + header.sequenceLength).toBeLessThanOrEqual(length);
      expect(header.sequenceOffset + header.sequenceLength).toBeLessThanOrEqual(header.frameLength);
      expect(header.frameLength).toBeLessThanOrEqual(MAX_POINTS_PER_FRAME * 8);
      expect((header.sequenceLength | header.sequenceOffset | header.frameLength) % 8).toBe(0);
    }),
    { seed: 1, numRuns: 5000 },
  );
  expect(accepted).toBeGreaterThan(50);
});
