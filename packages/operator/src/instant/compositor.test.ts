import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type Run, runCompositor, type SimulatedSource } from '../testing/compositor-run.ts';
import { Compositor, type DroppedItem } from './compositor.ts';

const HZ_60 = 1000 / 60;
const HZ_30 = 1000 / 30;
const HZ_15 = 1000 / 15;

/** Seeded random numbers, 0…1 (mulberry32). */
function randomOf(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Share of the presentations after which these sources show the same instant. */
function shareInStep({ shown }: Run, names: readonly string[]): number {
  const both = shown.filter((each) => names.every((name) => each.has(name)));
  const equal = both.filter((each) => new Set(names.map((name) => each.get(name))).size === 1);
  return equal.length / both.length;
}

function expectAllOut({ out, mostInside, stats }: Run, sources: number): void {
  expect(out.every((times) => times === 1)).toBe(true);
  // Six wait, and one more is inside for as long as it is being offered.
  expect(mostInside).toBeLessThanOrEqual(6 * sources + 1);
  expect(stats.presentations).toBeGreaterThan(0);
}

const jitter = fc.double({ min: 0, max: 25, noNaN: true });
const delay = fc.double({ min: 5, max: 100, noNaN: true });
const seed = fc.nat(2 ** 31);

describe('simultaneously triggered cameras', () => {
  test('are presented in step in 99 of 100 presentations, in spite of jitter and unequal delays', () => {
    const difference = fc.double({ min: 0, max: 20, noNaN: true });
    fc.assert(
      fc.property(seed, delay, difference, jitter, (from, delayMs, laterMs, jitterMs) => {
        const sources: SimulatedSource[] = [
          { name: 'a', intervalMs: HZ_30, delayMs, jitterMs },
          { name: 'b', intervalMs: HZ_30, delayMs: delayMs + laterMs, jitterMs },
        ];
        const run = runCompositor({ sources, lengthMs: 10_000, random: randomOf(from) });
        expect(shareInStep(run, ['a', 'b'])).toBeGreaterThanOrEqual(0.99);
        expect(run.stats.spreadMs?.p99).toBeLessThan(0.001);
        // Hardly a frame is left out for it.
        expect(run.presentations.length).toBeGreaterThan(270);
        expectAllOut(run, 2);
      }),
      longProperty(1, 60),
    );
  });

  test('stay in step while frames are lost: those that have a partner are presented with it', () => {
    fc.assert(
      fc.property(seed, fc.double({ min: 0.01, max: 0.2, noNaN: true }), (from, loss) => {
        const sources: SimulatedSource[] = [
          { name: 'a', intervalMs: HZ_30, delayMs: 30, jitterMs: 10, loss },
          { name: 'b', intervalMs: HZ_30, delayMs: 40, jitterMs: 10, loss },
        ];
        const run = runCompositor({ sources, lengthMs: 20_000, random: randomOf(from) });
        const together = run.presentations.filter(({ items }) => items.length === 2);
        const equal = together.filter(({ items }) => items[0]?.captureMs === items[1]?.captureMs);
        expect(equal.length / together.length).toBeGreaterThanOrEqual(0.99);
        expect(together.length).toBeGreaterThan(600 * (1 - loss) ** 2 * 0.9);
        // Alone they are presented only where several frames in a row are lost.
        expect(shareInStep(run, ['a', 'b'])).toBeGreaterThan(1 - 5 * loss ** 2 - 0.06);
        expectAllOut(run, 2);
      }),
      longProperty(2, 60),
    );
  });

  test('of different rates, with a cloud: whatever was captured together is presented together', () => {
    fc.assert(
      fc.property(seed, delay, jitter, (from, delayMs, jitterMs) => {
        const sources: SimulatedSource[] = [
          { name: 'fast', intervalMs: HZ_60, delayMs, jitterMs: jitterMs / 2 },
          { name: 'slow', intervalMs: HZ_30, delayMs: delayMs + 8, jitterMs: jitterMs / 2 },
          { name: 'cloud', intervalMs: HZ_15, delayMs, jitterMs: jitterMs / 2 },
        ];
        const run = runCompositor({ sources, lengthMs: 10_000, stepMs: 5, random: randomOf(from) });
        // Once the rates are known.
        const settled = run.shown.slice(60);
        const whole = settled.filter((shown) => {
          const at = shown.get('fast') as number;
          const due = (intervalMs: number) => Math.floor(at / intervalMs + 1e-6) * intervalMs;
          return (
            Math.abs((shown.get('slow') as number) - due(HZ_30)) < 0.01 &&
            Math.abs((shown.get('cloud') as number) - due(HZ_15)) < 0.01
          );
        });
        expect(whole.length / settled.length).toBeGreaterThanOrEqual(0.99);
        // The fast camera is not slowed down to the rate of the others.
        const fast = run.stats.sources.find(({ source }) => source === 'fast');
        expect(fast?.presented).toBeGreaterThan(480);
        expectAllOut(run, 3);
      }),
      longProperty(3, 60),
    );
  });
});

test('nobody waits longer than an interval of the slowest source and 10 ms', () => {
  fc.assert(
    fc.property(seed, delay, delay, fc.double({ min: 0, max: 0.5, noNaN: true }), (from, a, b, loss) => {
      const sources: SimulatedSource[] = [
        { name: 'a', intervalMs: HZ_30, delayMs: a, jitterMs: 60, loss },
        { name: 'b', intervalMs: HZ_30, phaseMs: 9, delayMs: b, jitterMs: 60, loss },
        { name: 'cloud', intervalMs: HZ_15, delayMs: 20, loss },
      ];
      const run = runCompositor({ sources, lengthMs: 8000, stepMs: 2, random: randomOf(from) });
      // Losses make the estimated interval longer than the true one, at most to a few times.
      const bound = Math.max(...run.stats.sources.map(({ intervalMs }) => intervalMs), 4 * HZ_15) + 10 + 2;
      expect(Math.max(...run.waitedMs)).toBeLessThanOrEqual(bound);
      expectAllOut(run, 3);
    }),
    longProperty(4, 60),
  );
});

test('a source that stops is waited for shortly, then no more; when it returns, it is in step again', () => {
  fc.assert(
    fc.property(seed, jitter, (from, jitterMs) => {
      const sources: SimulatedSource[] = [
        { name: 'a', intervalMs: HZ_30, delayMs: 30, jitterMs },
        { name: 'b', intervalMs: HZ_30, delayMs: 35, jitterMs, pauseMs: [3000, 6000] },
      ];
      const run = runCompositor({ sources, lengthMs: 10_000, random: randomOf(from) });
      const waits = run.presentations.filter(({ waitedFor }) => waitedFor.includes('b'));
      expect(waits.length).toBeLessThanOrEqual(12);
      // Meanwhile the other one goes on at its full rate.
      const alone = run.presentations.filter(({ atMs }) => atMs > 3500 && atMs < 6000);
      expect(alone.length).toBeGreaterThan(65);
      const after = run.shown.filter((_, i) => (run.presentations[i]?.atMs ?? 0) > 6500);
      const equal = after.filter((shown) => shown.get('a') === shown.get('b'));
      expect(equal.length / after.length).toBeGreaterThanOrEqual(0.98);
      expectAllOut(run, 2);
    }),
    longProperty(5, 40),
  );
});

test('a source that is always much later than the others is presented by itself, at its full rate', () => {
  const sources: SimulatedSource[] = [
    { name: 'a', intervalMs: HZ_30, delayMs: 20, jitterMs: 5 },
    { name: 'b', intervalMs: HZ_30, delayMs: 22, jitterMs: 5 },
    { name: 'relayed', intervalMs: HZ_30, delayMs: 300, jitterMs: 5 },
  ];
  const run = runCompositor({ sources, lengthMs: 6000, random: randomOf(6) });
  expect(run.stats.sources.map(({ state }) => state)).toEqual(['in-step', 'in-step', 'apart']);
  for (const { presented } of run.stats.sources) expect(presented).toBeGreaterThan(155);
  expect(Math.max(...run.waitedMs)).toBeLessThan(HZ_30 + 10 + HZ_60);
  expect(shareInStep(run, ['a', 'b'])).toBeGreaterThan(0.98);
});

test('unsynchronised, everything is presented at the next decision', () => {
  const sources: SimulatedSource[] = [
    { name: 'a', intervalMs: HZ_30, delayMs: 20, jitterMs: 5 },
    { name: 'b', intervalMs: HZ_30, delayMs: 45, jitterMs: 5 },
  ];
  const run = runCompositor({ sources, lengthMs: 4000, synchronised: false, random: randomOf(7) });
  expect(Math.max(...run.waitedMs)).toBeLessThanOrEqual(HZ_60);
  expect(run.stats.spreadMs?.p99).toBeGreaterThan(30);
  expect(run.stats.sources.every(({ state, waits }) => state === 'apart' && waits === 0)).toBe(true);
});

describe('what is not presented comes back with a reason', () => {
  const bench = () => {
    const dropped: DroppedItem<string>[] = [];
    const compositor = new Compositor<string>({ onDrop: (item) => dropped.push(item) });
    return {
      compositor,
      dropped,
      reasons: () => dropped.map(({ payload, reason }) => `${payload} ${reason}`),
    };
  };

  test('superseded and late', () => {
    const { compositor, reasons } = bench();
    compositor.offer('a', 100, 'a100', 120);
    compositor.offer('a', 133, 'a133', 153);
    expect(compositor.decide(153)?.items).toEqual([{ source: 'a', captureMs: 133, payload: 'a133' }]);
    compositor.offer('a', 120, 'a120', 154);
    expect(compositor.decide(155)).toBe(null);
    expect(reasons()).toEqual(['a100 superseded', 'a120 late']);
  });

  test('overflow and removed', () => {
    const { compositor, dropped, reasons } = bench();
    for (let i = 0; i < 8; i++) compositor.offer('a', i, `a${i}`, i);
    expect(reasons()).toEqual(['a0 overflow', 'a1 overflow']);
    compositor.remove('a');
    compositor.remove('unknown');
    expect(dropped.slice(2).every(({ reason }) => reason === 'removed')).toBe(true);
    expect(dropped).toHaveLength(8);
    // Afterwards the source begins anew, also with an earlier instant.
    compositor.offer('a', 1, 'again', 10);
    expect(compositor.decide(10)?.items).toHaveLength(1);
  });
});
