import { stampUsOf } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { captureMsOfRtp, captureMsOfStamp, isSameInstant } from './capture-instant.ts';

const WRAP = 2 ** 32;
const rtpOf = (ms: number): number => Math.floor(ms * 90) % WRAP;

test('the instant of an RTP timestamp, before, at and after its wrap', () => {
  const wrapMs = WRAP / 90;
  expect(captureMsOfRtp(9000, 120)).toBe(100);
  expect(captureMsOfRtp(WRAP - 90, wrapMs + 5)).toBeCloseTo(wrapMs - 1, 6);
  expect(captureMsOfRtp(90, wrapMs - 5)).toBeCloseTo(wrapMs + 1, 6);
  expect(captureMsOfRtp(WRAP - 90, 0)).toBe(-1);
});

test('finds any instant again from its stamp and a rough idea of the time', () => {
  const instant = fc.double({ min: 0, max: 1e9, noNaN: true });
  const error = fc.double({ min: -1e6, max: 1e6, noNaN: true });
  fc.assert(
    fc.property(instant, error, (ms, off) => {
      const found = captureMsOfRtp(rtpOf(ms), ms + off);
      expect(ms - found).toBeGreaterThanOrEqual(-1e-6);
      expect(ms - found).toBeLessThan(1 / 90 + 1e-6);
      expect(Math.abs(captureMsOfStamp(stampUsOf(ms), ms + off) - ms)).toBeLessThan(0.0011);
    }),
    { seed: 1, numRuns: 1000 },
  );
});

test('equal timestamps give equal instants, whatever the reference', () => {
  fc.assert(
    fc.property(fc.nat(WRAP - 1), fc.double({ min: -9e5, max: 9e5, noNaN: true }), (stamp, off) => {
      const near = captureMsOfRtp(stamp, 5e7);
      expect(captureMsOfRtp(stamp, near + off)).toBe(near);
    }),
    { seed: 2, numRuns: 1000 },
  );
});

test('a video’s frame and a cloud of one capture are of one instant; those of the next one, at 120 Hz, are not', () => {
  fc.assert(
    fc.property(fc.double({ min: 0, max: 1e9, noNaN: true }), (ms) => {
      const cloudUs = stampUsOf(ms);
      expect(isSameInstant(stampUsOf(captureMsOfRtp(rtpOf(ms), ms)), cloudUs)).toBe(true);
      expect(isSameInstant(stampUsOf(captureMsOfRtp(rtpOf(ms + 1000 / 120), ms)), cloudUs)).toBe(false);
    }),
    { seed: 3, numRuns: 1000 },
  );
});
