import fc from 'fast-check';
import { expect, test } from 'vitest';
import { RELEASE_HOLD_MS, ReleaseHold } from './release-hold.ts';

class Bench {
  readonly hold = new ReleaseHold();
  now = 0;
  latched = true;
  releases = 0;

  pass(ms: number, stepMs = 25): this {
    for (const end = this.now + ms; this.now < end; ) {
      this.now += stepMs;
      if (this.hold.advance(this.now, this.latched)) this.releases++;
    }
    return this;
  }
}

test('releases once after a hold of one second, and reports the progress', () => {
  const bench = new Bench().pass(100);
  bench.hold.set('pointer', true);
  bench.pass(525);
  expect(bench.hold.progress.value).toBe(0.5);
  bench.pass(475);
  expect(bench.releases).toBe(0);
  bench.pass(25);
  expect([bench.releases, bench.hold.progress.value]).toEqual([1, 0]);
  bench.pass(10_000);
  expect(bench.releases).toBe(1);
});

test('does nothing when let go early, and starts the next hold from zero', () => {
  const bench = new Bench().pass(100);
  for (let i = 0; i < 20; i++) {
    bench.hold.set('key', true);
    bench.pass(900);
    bench.hold.set('key', false);
    bench.pass(25);
    expect(bench.hold.progress.value).toBe(0);
  }
  expect(bench.releases).toBe(0);
});

test('ignores a control that was already held when stop was pressed, the first time or again', () => {
  const bench = new Bench();
  bench.latched = false;
  bench.hold.set('headset', true);
  bench.pass(5000);
  bench.latched = true;
  bench.pass(5000);
  expect(bench.releases).toBe(0);
  bench.hold.set('headset', false);
  bench.pass(25);
  bench.hold.set('headset', true);
  bench.pass(900);
  bench.hold.cancel();
  bench.pass(5000);
  expect(bench.releases).toBe(0);
});

test('does not let a second control continue the hold of the first', () => {
  const bench = new Bench().pass(25);
  bench.hold.set('pointer', true);
  bench.pass(800);
  bench.hold.set('key', true);
  bench.hold.set('pointer', false);
  bench.pass(5000);
  expect(bench.releases).toBe(0);
});

test('counts hardly any of the time for which the page hung', () => {
  const bench = new Bench().pass(25);
  bench.hold.set('pointer', true);
  bench.pass(100);
  bench.pass(10_000, 10_000);
  expect(bench.releases).toBe(0);
  expect(bench.hold.progress.value).toBeLessThan(0.2);
  bench.hold.letGo();
  bench.pass(5000);
  expect(bench.releases).toBe(0);
});

test('never releases before one control was held for a second, whatever is pressed', () => {
  const step = fc.record({
    control: fc.constantFrom('pointer', 'key', 'gamepad', 'headset' as const),
    down: fc.boolean(),
    ms: fc.integer({ min: 0, max: 1500 }),
    event: fc.constantFrom('none', 'none', 'none', 'cancel', 'letGo', 'latch', 'unlatch'),
  });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 40 }), (steps) => {
      const bench = new Bench();
      const since = new Map<string, number>();
      for (const { control, down, ms, event } of steps) {
        bench.hold.set(control, down);
        if (!down) since.delete(control);
        else if (!since.has(control)) since.set(control, bench.now);
        if (event === 'cancel') bench.hold.cancel();
        if (event === 'letGo') {
          bench.hold.letGo();
          since.clear();
        }
        if (event === 'latch' || event === 'unlatch') bench.latched = event === 'latch';
        const { releases } = bench;
        bench.pass(ms);
        if (bench.releases === releases) continue;
        expect(bench.latched).toBe(true);
        expect(Math.max(...[...since.values()].map((at) => bench.now - at))).toBeGreaterThanOrEqual(
          RELEASE_HOLD_MS,
        );
      }
    }),
    { seed: 5, numRuns: 500 },
  );
});
