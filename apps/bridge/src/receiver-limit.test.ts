import { expect, it } from 'vitest';
import { ReceiverLimit } from './receiver-limit.ts';

it('grows to twice the received rate, holds at low loss, falls at high loss, and stays within its bounds', () => {
  const limit = new ReceiverLimit({ startBitsPerSecond: 10e6, maxBitsPerSecond: 50e6 });
  for (let i = 0; i < 100; i++) limit.onFrame(0, 12e6);
  expect(limit.bitsPerSecond).toBe(24e6);
  expect(limit.onFrame(0.05, 12e6)).toBe(24e6);
  expect(limit.onFrame(0.5, 12e6)).toBe(18e6);
  for (let i = 0; i < 100; i++) limit.onFrame(0, 80e6);
  expect(limit.bitsPerSecond).toBe(50e6);
  for (let i = 0; i < 100; i++) limit.onFrame(1, 0);
  expect(limit.bitsPerSecond).toBe(1e6);
});
