import { describe, expect, it } from 'vitest';
import { capturedAtMs } from './capture-time.ts';

const WALL_NS = 1_700_000_000_000_000_000n;
/** @param pauses how long the thread is without the processor after each reading of the clock, ms */
function clockAt(startMs: number, pauses: number[] = []) {
  let ms = startMs;
  return {
    now: () => {
      const read = ms;
      ms += pauses.shift() ?? 0;
      return read;
    },
    wallNs: () => WALL_NS + BigInt(Math.round(ms * 1e6)),
  };
}
const stampAt = (ms: number) => WALL_NS + BigInt(ms * 1e6);

describe('the capture time', () => {
  it('of one stamp is one instant, whenever the message arrives', () => {
    for (const arrival of [1000, 1001, 1033.5, 1450])
      expect(capturedAtMs(clockAt(arrival), stampAt(1000), arrival)).toBeCloseTo(1000, 6);
  });

  it('is not shifted where the thread loses the processor between two readings', () => {
    expect(capturedAtMs(clockAt(1040, [7, 3]), stampAt(1000), 1040)).toBeCloseTo(1000, 6);
  });

  it('of an old stamp is old', () => {
    for (const ageMs of [450, 700, 5000, 3_600_000])
      expect(capturedAtMs(clockAt(1040), stampAt(1040 - ageMs), 1035)).toBeCloseTo(1040 - ageMs, 4);
  });

  it.each([
    ['from the future', 1050],
    ['of another clock', -100_000_000],
  ])('of a stamp that is %s is the arrival', (_, stamp) => {
    expect(capturedAtMs(clockAt(1040), stampAt(stamp), 1035)).toBe(1035);
  });
});
