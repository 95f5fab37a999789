import fc from 'fast-check';
import { expect, it, test } from 'vitest';
import { readAbsCaptureTime, writeAbsCaptureTime } from './abs-capture-time.ts';

const captured = { seconds: 0xeead9be0, fraction: 0x40000000 };

function bytesOf(clockOffsetMs: number | null): string {
  const room = new Uint8Array(20);
  const length = writeAbsCaptureTime({ captured, clockOffsetMs }, room, 1);
  expect([...room.subarray(0, 1), ...room.subarray(1 + length)].every((byte) => byte === 0)).toBe(true);
  return Buffer.from(room.subarray(1, 1 + length)).toString('hex');
}

test.each<[number | null, string]>([
  [null, ''],
  [0, '0000000000000000'],
  [1500, '0000000180000000'],
  [-1500, 'fffffffe80000000'],
  [-0.25, 'ffffffffffef9db2'],
  [-1e-15, 'ffffffffffffffff'],
  [-2_147_483_648_000, '8000000000000000'],
])('an offset of %s ms', (clockOffsetMs, hex) => {
  expect(bytesOf(clockOffsetMs)).toBe(`eead9be040000000${hex}`);
  const time = readAbsCaptureTime(new Uint8Array(Buffer.from(`eead9be040000000${hex}`, 'hex')));
  expect(time?.captured).toEqual(captured);
  if (clockOffsetMs === null) expect(time?.clockOffsetMs).toBeNull();
  else expect(time?.clockOffsetMs).toBeCloseTo(clockOffsetMs, 6);
});

it('refuses offsets that do not fit, and a place without room', () => {
  for (const clockOffsetMs of [Number.NaN, Number.POSITIVE_INFINITY, 2_147_483_648_000, -2_147_483_648_001])
    expect(() => bytesOf(clockOffsetMs)).toThrow(RangeError);
  expect(() => writeAbsCaptureTime({ captured, clockOffsetMs: null }, new Uint8Array(8), 1)).toThrow(
    RangeError,
  );
});

it('reads 8 or 16 bytes and nothing else, whatever they are', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 20 }), (data) => {
      const time = readAbsCaptureTime(data);
      expect(time !== null).toBe(data.length === 8 || data.length === 16);
      if (time !== null) expect(time.clockOffsetMs === null).toBe(data.length === 8);
    }),
    { seed: 2, numRuns: 1000 },
  );
});
