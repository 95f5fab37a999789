import fc from 'fast-check';
import { expect, it } from 'vitest';
import { REFRESH_INTERVAL_MS, RefreshPace, soundLifetimeS } from './relay-lifetime.ts';

it('believes a usual lifetime, and bounds any other', () => {
  expect([600, 60, 3600, 0, -1, 0xffff_ffff].map(soundLifetimeS)).toEqual([600, 60, 3600, 60, 60, 3600]);
  for (const told of [undefined, null, Number.NaN, Number.POSITIVE_INFINITY, '600', {}])
    expect(soundLifetimeS(told)).toBe(600);
});

it('asks at most once in the interval, however often it is due', () => {
  fc.assert(
    fc.property(fc.array(fc.nat(30_000), { maxLength: 50 }), (pauses) => {
      const pace = new RefreshPace(0);
      let [now, last] = [0, 0];
      for (const pause of pauses) {
        now += pause;
        now += pace.take(now);
        expect(now - last).toBeGreaterThanOrEqual(REFRESH_INTERVAL_MS);
        last = now;
      }
    }),
  );
});
