import { expect, test } from 'vitest';
import { WISH_HOLDS_MS, WishInput } from './wish-input.ts';

test('a wish holds while it is renewed', () => {
  const input = new WishInput();
  for (let nowMs = 0; nowMs < 1000; nowMs += WISH_HOLDS_MS - 1) {
    input.lapse(nowMs);
    input.renew({ forward: 1, left: -0.5 }, nowMs);
  }
  expect(input.held).toBe(true);
  expect(input.wish).toEqual({ forward: 1, left: -0.5 });
});

test('a wish that is not renewed is let go', () => {
  const input = new WishInput();
  input.renew({ forward: 1, left: 0 }, 1000);
  input.lapse(1000 + WISH_HOLDS_MS - 1);
  expect(input.held).toBe(true);
  input.lapse(1000 + WISH_HOLDS_MS);
  expect(input.held).toBe(false);
  expect(input.wish).toEqual({ forward: 0, left: 0 });
});
