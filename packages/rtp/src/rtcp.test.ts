import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type RtcpFault, walkRtcp } from './rtcp.ts';

/** A packet of `words` 32-bit words after the first. */
function packet(format: number, packetType: number, words: number): number[] {
  return [0x80 | format, packetType, words >> 8, words & 0xff, ...Array(words * 4).fill(0xee)];
}

test('walks a compound packet; each part is a view into it', () => {
  const bytes = new Uint8Array([...packet(1, 201, 7), ...packet(1, 202, 3), ...packet(15, 205, 5)]);
  const packets = [...walkRtcp(bytes)];
  expect(packets.map((p) => [p.packetType, p.format, p.bytes.byteOffset, p.bytes.length])).toEqual([
    [201, 1, 0, 32],
    [202, 1, 32, 16],
    [205, 15, 48, 24],
  ]);
  expect(packets.every((p) => p.bytes.buffer === bytes.buffer)).toBe(true);
});

test('reads a packet that consists of its header alone', () => {
  expect([...walkRtcp(new Uint8Array(packet(0, 203, 0)))]).toHaveLength(1);
});

test.each<[string, number[], number, RtcpFault, number]>([
  ['ends inside a header', [...packet(1, 201, 7), 0x80, 201, 0], 1, 'truncated', 32],
  ['ends inside a packet', [...packet(1, 201, 7), 0x80, 201, 0, 9, 0], 1, 'truncated', 32],
  ['another version', [...packet(1, 201, 1), 0x40, 201, 0, 0], 1, 'bad-version', 8],
])('%s: what came before is valid', (_name, bytes, good, fault, offset) => {
  const faults: [RtcpFault, number][] = [];
  const packets = [...walkRtcp(new Uint8Array(bytes), (f, at) => faults.push([f, at]))];
  expect(packets).toHaveLength(good);
  expect(faults).toEqual([[fault, offset]]);
});

test('any bytes end the walk, and its packets are whole and in order', () => {
  const header = fc.tuple(
    fc.constantFrom(0x80, 0x8f, 0x81),
    fc.constantFrom(200, 205),
    fc.constant(0),
    fc.nat(3),
  );
  const noise = fc.uint8Array({ maxLength: 24, size: 'max' }).map((b) => [...b]);
  fc.assert(
    fc.property(fc.array(fc.oneof(header, noise), { maxLength: 12, size: 'max' }), (parts) => {
      const bytes = new Uint8Array(parts.flat());
      let at = 0;
      let fault = false;
      for (const packet of walkRtcp(bytes, () => (fault = true))) {
        expect(packet.bytes.byteOffset).toBe(at);
        expect(packet.bytes.length % 4).toBe(0);
        at += packet.bytes.length;
      }
      expect(at).toBeLessThanOrEqual(bytes.length);
      expect(fault).toBe(at < bytes.length);
    }),
    { seed: 1, numRuns: 1000 },
  );
});
