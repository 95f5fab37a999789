import { expect, test } from 'vitest';
import { LossJudge, type LossVerdict } from './loss-judge.ts';

/** A message of 100 packets every 60 ms, with fraction `loss` lost, until a verdict. @returns it and the time after */
function until(judge: LossJudge, loss: number, fromMs: number, wanted: LossVerdict): number {
  for (let t = fromMs; t < fromMs + 5000; t += 60) {
    const lost = Math.round(100 * loss);
    if (judge.onFeedback(100 - lost, lost, t - 60, t) === wanted) return t;
  }
  throw new Error(`no verdict '${wanted}'`);
}

test('loss that a lower rate ends was overload', () => {
  const judge = new LossJudge();
  const cut = until(judge, 0.1, 1000, 'excess');
  judge.cutAt(cut);
  expect(judge.onTrial).toBe(true);
  until(judge, 0, cut, 'guilty');
  expect(judge.base).toBe(0);
});

test('loss that stays is the link’s own, and no longer a reason to cut', () => {
  const judge = new LossJudge();
  const cut = until(judge, 0.2, 1000, 'excess');
  judge.cutAt(cut);
  const end = until(judge, 0.2, cut, 'innocent');
  expect(judge.base).toBeCloseTo(0.2);
  expect(() => until(judge, 0.2, end, 'excess')).toThrow();
  // Overload on top of it is still detected, and so is a link that improves.
  until(judge, 0.3, end, 'excess');
});

test.each([
  { base: 0, loss: 0.02, verdict: 'none' },
  { base: 0, loss: 0.04, verdict: 'excess' },
  { base: 0.01, loss: 0.03, verdict: 'none' },
  { base: 0.01, loss: 0.05, verdict: 'excess' },
])('loss of $loss over a base of $base: $verdict', ({ base, loss, verdict }) => {
  const judge = new LossJudge();
  judge.base = base;
  expect(judge.onFeedback(1000 * (1 - loss), 1000 * loss, 0, 0)).toBe('none');
  expect(judge.onFeedback(1000 * (1 - loss), 1000 * loss, 0, 1000)).toBe(verdict);
});

test('packets sent before the cut do not count as evidence', () => {
  const judge = new LossJudge();
  judge.cutAt(until(judge, 0.1, 1000, 'excess') + 10_000);
  expect(() => until(judge, 0.1, 1300, 'innocent')).toThrow();
});

test('lower loss lowers the base', () => {
  const judge = new LossJudge();
  judge.base = 0.2;
  for (let t = 0; t < 5000; t += 60) judge.onFeedback(100, 0, t - 60, t);
  expect(judge.base).toBeLessThan(0.02);
});

test('a trial on a slow link ends within 2 s', () => {
  const judge = new LossJudge();
  let now = 0;
  // One packet every 50 ms, in pairs; a fifth is lost.
  const until = (verdict: string): number => {
    for (let i = 0; i < 100; i++) {
      now += 100;
      if (judge.onFeedback(i % 5 < 3 ? 2 : 1, i % 5 < 3 ? 0 : 1, now - 50, now) === verdict) return now;
    }
    return Number.NaN;
  };
  const cutMs = until('excess');
  judge.cutAt(cutMs);
  expect(until('innocent') - cutMs).toBeLessThan(2000);
});
