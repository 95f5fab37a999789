import { expect, test } from 'vitest';
import { EncoderProgress } from './encoder-progress.ts';

/** One line of statistics a second. @returns after how many seconds it is stuck, or `null` */
function stuckAfter(
  seconds: number,
  at: (second: number) => [framesIn: number, skipped: number, encoded: number],
) {
  const progress = new EncoderProgress();
  for (let second = 0; second <= seconds; second++) {
    const [framesIn, skipped, encoded] = at(second);
    if (progress.onStats({ framesIn, skipped, encoded }) !== null) return second;
  }
  return null;
}

test('an encoder that gives nothing more is stuck 10 s after pictures came', () => {
  expect(stuckAfter(60, (s) => [s * 30, 0, Math.min(s, 20) * 30])).toBe(30);
  expect(stuckAfter(60, (s) => [s * 30, 0, 0])).toBe(10);
});

test('says how many came', () => {
  const progress = new EncoderProgress();
  let said: string | null = null;
  for (let s = 0; s <= 10; s++) said = progress.onStats({ framesIn: s * 30, skipped: 0, encoded: 0 });
  expect(said).toBe('it has given no picture for 10 s, while 300 came');
});

test('one that is slow, has little to do, or whose camera rests, is not', () => {
  expect(stuckAfter(600, (s) => [s * 30, 0, Math.floor(s / 9)])).toBeNull();
  expect(stuckAfter(600, (s) => [s * 30, s * 30, 5])).toBeNull();
  expect(stuckAfter(600, (s) => [Math.min(s, 20) * 30, 0, Math.min(s, 20) * 30])).toBeNull();
  // A few pictures are still in the pipeline when the camera stops.
  expect(stuckAfter(600, (s) => [s === 0 ? 0 : 103, 0, s === 0 ? 0 : 100])).toBeNull();
});
