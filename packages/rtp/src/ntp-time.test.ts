import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  type NtpTime,
  ntpOfUnixMs,
  ntpOfUnixNanoseconds,
  readNtp,
  unixMsOfNtp,
  writeNtp,
} from './ntp-time.ts';

/** Exact, in units of 2⁻³² s. */
const unitsOf = ({ seconds, fraction }: NtpTime) => (BigInt(seconds) << 32n) | BigInt(fraction);
const microseconds = (units: bigint) => Number((units * 1_000_000n * 1000n) >> 32n) / 1000;

describe('ntpOfUnixMs', () => {
  it.each<[string, number, NtpTime]>([
    ['the Unix epoch', 0, { seconds: 2_208_988_800, fraction: 0 }],
    ['half a second later', 500, { seconds: 2_208_988_800, fraction: 0x8000_0000 }],
    ['2026-11-23 06:00 UTC', Date.UTC(2026, 10, 23, 6), { seconds: 0xeeae_54e0, fraction: 0 }],
    [
      'the last second before the wrap',
      Date.UTC(2036, 1, 7, 6, 28, 15),
      { seconds: 0xffff_ffff, fraction: 0 },
    ],
    ['the wrap', Date.UTC(2036, 1, 7, 6, 28, 16), { seconds: 0, fraction: 0 }],
  ])('%s', (_name, unixMs, time) => {
    expect(ntpOfUnixMs(unixMs)).toEqual(time);
    expect(unixMsOfNtp(time)).toBe(unixMs);
  });

  it('is exact to less than a microsecond, and so is the way back', () => {
    const wholeMs = fc.integer({ min: 0, max: 4_000_000_000_000 });
    const nanoseconds = fc.oneof(fc.nat(999_999), fc.constantFrom(0, 1, 999_999));
    fc.assert(
      fc.property(wholeMs, nanoseconds, (ms, ns) => {
        const units = (BigInt(ms) << 32n) / 1000n + (BigInt(ns) << 32n) / 1_000_000_000n;
        const exact = (units + (2_208_988_800n << 32n)) % (1n << 64n);
        const unixMs = ms + ns / 1e6;
        const time = ntpOfUnixMs(unixMs);
        expect(Math.abs(microseconds(unitsOf(time) - exact))).toBeLessThan(0.5);
        expect(Math.abs(unixMsOfNtp(time) - unixMs)).toBeLessThan(0.001);
        const fine = ntpOfUnixNanoseconds(Math.floor(ms / 1000), (ms % 1000) * 1e6 + ns);
        expect(Math.abs(microseconds(unitsOf(fine) - exact))).toBeLessThanOrEqual(0.001);
        for (const { seconds, fraction } of [time, fine]) {
          expect([seconds >>> 0, fraction >>> 0]).toEqual([seconds, fraction]);
        }
      }),
      { seed: 1, numRuns: 5000 },
    );
  });
});

it('is written big-endian', () => {
  const view = new DataView(new ArrayBuffer(10));
  writeNtp(view, 1, { seconds: 0x01020304, fraction: 0xfffefdfc });
  expect([...new Uint8Array(view.buffer)]).toEqual([0, 1, 2, 3, 4, 0xff, 0xfe, 0xfd, 0xfc, 0]);
  expect(readNtp(view, 1)).toEqual({ seconds: 0x01020304, fraction: 0xfffefdfc });
});
