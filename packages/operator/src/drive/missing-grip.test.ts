import { expect, test } from 'vitest';
import { MissingGrip } from './missing-grip.ts';

function device(held: boolean, forward: number, pushed?: boolean) {
  const wish = { forward, left: 0 };
  return { name: 'keyboard' as const, held, wish, readMs: null, ...(pushed === undefined ? {} : { pushed }) };
}

test('a push without a grip is told once, after a moment', () => {
  const [grip, keys] = [new MissingGrip(), device(false, 1)];
  expect(grip.update([keys], 0)).toBeNull();
  expect(grip.update([keys], 399)).toBeNull();
  expect(grip.update([keys], 400)).toBe(keys);
  expect(grip.update([keys], 5000)).toBeNull();
  // Let go, and pushed again.
  keys.wish.forward = 0;
  expect(grip.update([keys], 5025)).toBeNull();
  keys.wish.forward = -1;
  expect(grip.update([keys], 5050)).toBeNull();
  expect(grip.update([keys], 5450)).toBe(keys);
});

test('a grip that follows in time says nothing, nor does one that is held on', () => {
  const [grip, keys] = [new MissingGrip(), device(false, 1)];
  grip.update([keys], 0);
  keys.held = true;
  expect(grip.update([keys], 300)).toBeNull();
  expect(grip.update([keys], 3000)).toBeNull();
  // The grip is opened before the key: the time counts from there.
  keys.held = false;
  expect(grip.update([keys], 3025)).toBeNull();
  expect(grip.update([keys], 3425)).toBe(keys);
});

test('a device that says by itself whether it is pushed is believed', () => {
  const [grip, stick] = [new MissingGrip(), device(false, 0, true)];
  grip.update([stick], 0);
  expect(grip.update([stick], 400)).toBe(stick);
  const idle = device(false, 1, false);
  grip.update([idle], 0);
  expect(grip.update([idle], 400)).toBeNull();
});
