import { returnEnds } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { motionWords, returnWords } from './motion-words.ts';

test('every end has words of its own', () => {
  const texts = returnEnds.map((end) => returnWords({ phase: 'ended', metres: 2, end }).text);
  expect(new Set(texts).size).toBe(returnEnds.length);
});

test('says what the robot does, and how far it has come', () => {
  expect(returnWords({ phase: 'announcing', metres: 0 }).text).toContain('is about to drive back');
  expect(returnWords({ phase: 'returning', metres: 1 }).text).toContain('drives back along its track');
  expect(returnWords({ phase: 'ended', metres: 2.34, end: 'service-back' }).text).toBe(
    'The link was lost; it came back 2.3 m: until somebody was heard again',
  );
  expect(returnWords({ phase: 'ended', metres: 0, end: 'no-track' }).text).toBe(
    'The link was lost; the robot stayed: it knew no way',
  );
});

test('comes before everything else that bounds the motion', () => {
  const told = { phase: 'returning', metres: 1 } as const;
  const motion = { factor: 0.5, reasons: ['obstacle-near'], mostLinear: 1, return: told } as const;
  expect(motionWords(motion)).toEqual(returnWords(told));
});
