import fc from 'fast-check';
import { expect, test } from 'vitest';
import { GEARS, ScaledInput, SPEED_SHARES, SpeedChoice, usableShare } from './speed-choice.ts';

test('gears go up and down, and stay at the ends', () => {
  const speed = new SpeedChoice(0.6);
  const after = (act: 'faster' | 'slower' | 'cycle') => {
    speed[act]();
    return speed.share.value;
  };
  expect([after('faster'), after('faster'), after('faster')]).toEqual([0.75, 1, 1]);
  expect([after('cycle'), after('slower'), after('cycle')]).toEqual([0.25, 0.25, 0.5]);
  speed.set(0.1);
  expect(after('slower')).toBe(0.1);
  expect(GEARS).toEqual([0.25, 0.5, 0.75, 1]);
  expect([usableShare(0.01), usableShare(7), usableShare(Number.NaN)]).toEqual([0.1, 1, 1]);
});

test('whatever is chosen, a wish is never larger than the hand’s', () => {
  fc.assert(
    fc.property(fc.anything(), fc.double(), fc.double(), (share, forward, left) => {
      const choice = new SpeedChoice(share);
      // As if something had written past `set`.
      if (typeof share === 'number') choice.share.value = share;
      const input = new ScaledInput(
        { name: 'keyboard', held: true, wish: { forward, left }, readMs: 1 },
        choice,
      );
      for (const [made, wished] of [
        [input.wish.forward, forward],
        [input.wish.left, left],
      ] as const) {
        const most = Number.isFinite(wished) ? Math.min(Math.abs(wished), 1) : 0;
        expect(Math.abs(made)).toBeLessThanOrEqual(most);
        if (made !== 0) expect(Math.sign(made)).toBe(Math.sign(wished));
      }
      expect(usableShare(share)).toBeGreaterThanOrEqual(SPEED_SHARES.least);
      expect(usableShare(share)).toBeLessThanOrEqual(SPEED_SHARES.most);
    }),
    { seed: 13, numRuns: 500 },
  );
});

test('the grip and the reading are the device’s own', () => {
  const device = { name: 'gamepad' as const, held: false, wish: { forward: 1, left: -0.5 }, readMs: 3 };
  const input = new ScaledInput(device, new SpeedChoice(0.5));
  expect([input.name, input.held, input.readMs, input.wish]).toEqual([
    ...['gamepad', false, 3],
    { forward: 0.5, left: -0.25 },
  ]);
  device.held = true;
  device.readMs = 4;
  expect([input.held, input.readMs]).toEqual([true, 4]);
});

test('that a stick is pushed without the grip is the device’s own word, or what it wishes', () => {
  const choice = new SpeedChoice(0.5);
  const device = { name: 'gamepad' as const, held: false, wish: { forward: 0, left: 0 }, readMs: 3 };
  expect(new ScaledInput(device, choice).pushed).toBe(false);
  expect(new ScaledInput({ ...device, wish: { forward: 0, left: 0.2 } }, choice).pushed).toBe(true);
  for (const pushed of [true, false])
    expect(new ScaledInput({ ...device, pushed }, choice).pushed).toBe(pushed);
});

test('what goes sideways is scaled as well', () => {
  const device = { name: 'gamepad' as const, held: true, readMs: 3 };
  const of = (sideways?: number) =>
    new ScaledInput({ ...device, wish: { forward: 0, left: 0, sideways } }, new SpeedChoice(0.5)).wish;
  expect(of(-1)).toEqual({ forward: 0, left: 0, sideways: -0.5 });
  expect(of(Number.NaN)).toEqual({ forward: 0, left: 0, sideways: 0 });
  expect(of()).toEqual({ forward: 0, left: 0 });
});
