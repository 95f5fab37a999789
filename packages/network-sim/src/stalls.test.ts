import { expect, test } from 'vitest';
import { Random } from './random.ts';
import { Stalls } from './stalls.ts';

test('what is due in a stall happens at its end, in order; as often and as long as configured', () => {
  const stalls = new Stalls({ perSecond: 4, lengthMs: [5, 25] }, new Random(3, 0));
  let last = 0;
  let stalled = 0;
  for (let t = 0; t < 100_000; t++) {
    const at = stalls.after(t);
    if (at < Math.max(t, last) || at - t > 25) expect.fail(`what is due at ${t} ms happens at ${at} ms`);
    if (at > t) stalled++;
    last = at;
  }
  // 4 × 15 ms per second of running: 6 % of it.
  expect(stalled / 100_000).toBeGreaterThan(0.045);
  expect(stalled / 100_000).toBeLessThan(0.07);
  // An earlier time may be queried later.
  expect(stalls.after(10)).toBe(new Stalls({ perSecond: 4, lengthMs: [5, 25] }, new Random(3, 0)).after(10));
});
