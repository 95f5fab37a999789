import { expect, test } from 'vitest';
import { predictionWords, viewLead, viewWords } from './view-words.ts';

test('a prediction is called one, with how far ahead it is', () => {
  expect(viewWords({ state: 'predicted', aheadMs: 137.4 })).toBe('Predicted 140 ms ahead');
  expect(viewLead({ state: 'predicted', aheadMs: 137.4 })).toBe('  view +140 ms predicted');
});

test('what is not predicted is as reported, and why', () => {
  const of = (state: Parameters<typeof viewWords>[0]['state']) => viewWords({ state, aheadMs: 0 });
  expect(of('not-driving')).toBe('As reported');
  expect(of('held')).toContain('the robot is held');
  expect(of('stale')).toContain('nothing new');
  expect(of('off')).toContain('(P)');
  expect([viewLead({ state: 'held', aheadMs: 0 }), viewLead(undefined)]).toEqual(['', '']);
});

test('the key’s effect is said', () => {
  expect(predictionWords(true)).not.toBe(predictionWords(false));
});
