import { expect, test } from 'vitest';
import { IncomingRate } from './incoming-rate.ts';

/** Packets of 1,250 bytes, one per ms: 10 Mbit/s. */
function fill(rate: IncomingRate, from: number, to: number, arrival = (sent: number) => sent + 20): void {
  for (let ms = from; ms < to; ms++) rate.add(1250, ms, arrival(ms));
}

test('gives no rate for fewer than 10 packets', () => {
  const rate = new IncomingRate();
  fill(rate, 0, 9);
  expect(rate.bitsPerSecond).toBeNaN();
  fill(rate, 9, 10);
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo((10 * 9) / 8);
});

test('measures the rate over the last 500 packets', () => {
  const rate = new IncomingRate();
  fill(rate, 0, 1000, (sent) => 2 * sent);
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo(5, 1);
  fill(rate, 1000, 1500, (sent) => sent + 1000);
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo(10, 1);
});

test('measures over the last second on a slow path', () => {
  const rate = new IncomingRate();
  for (let ms = 0; ms < 2000; ms += 50) rate.add(1250, ms, ms);
  for (let ms = 2000; ms <= 3000; ms += 25) rate.add(1250, ms, ms);
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo((0.4 * 40) / 39);
});

test('gives the same rate for a path that stalls briefly and then releases everything', () => {
  const rate = new IncomingRate();
  fill(rate, 0, 500, (sent) => (sent >= 300 && sent < 340 ? 340 + (sent - 300) / 100 : sent));
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo(10, 0);
});

test('never exceeds the sending rate', () => {
  const rate = new IncomingRate();
  fill(rate, 0, 500, (sent) => 1000 + sent / 10);
  expect(rate.bitsPerSecond / 1e6).toBeCloseTo(10, 1);
});

test('forgets everything at a reset', () => {
  const rate = new IncomingRate();
  fill(rate, 0, 500);
  rate.reset();
  expect(rate.bitsPerSecond).toBeNaN();
});
