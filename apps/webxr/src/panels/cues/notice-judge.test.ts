import { beforeEach, expect, test } from 'vitest';
import { NoticeJudge } from './notice-judge.ts';

const refusal = { text: 'The emergency stop is on.', tone: 'warning' } as const;

let judge: NoticeJudge;
beforeEach(() => {
  judge = new NoticeJudge();
});

test('refusals and warnings are felt, good and neutral news are not', () => {
  expect(judge.next({ text: 'Connected to Ada', tone: 'good' }, 1000)).toBe(false);
  expect(judge.next({ text: 'View in the headset: tabletop', tone: 'neutral' }, 2000)).toBe(false);
  expect(judge.next(refusal, 3000)).toBe(true);
  expect(judge.next({ text: 'Could not enter VR', tone: 'bad' }, 4000)).toBe(true);
});

test('a refusal that comes with each command is felt once', () => {
  const felt = Array.from({ length: 400 }, (_, i) => judge.next(refusal, i * 25)).filter((each) => each);
  expect(felt).toHaveLength(1);
  expect(judge.next(refusal, 20_000)).toBe(true);
});

test('a banner or an obstacle is felt when it begins, not as long as it stands', () => {
  expect(judge.onStanding(false, 0)).toBe(false);
  expect(judge.onStanding(true, 1000)).toBe(true);
  expect(judge.onStanding(true, 5000)).toBe(false);
  expect(judge.onStanding(false, 6000)).toBe(false);
  expect(judge.onStanding(true, 7000)).toBe(true);
});

test('what a cue has just let the hands feel is not felt twice', () => {
  judge.onFelt(1000);
  expect(judge.next(refusal, 1100)).toBe(false);
  expect(judge.onStanding(true, 1600)).toBe(true);
  expect(judge.next({ text: 'Let go of the grip.', tone: 'warning' }, 1700)).toBe(false);
});
