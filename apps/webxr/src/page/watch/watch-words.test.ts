import { expect, test } from 'vitest';
import { watchWords } from './watch-words.ts';

const free = { obstacle: null, detail: '' };

test('says live only while something arrives', () => {
  expect(watchWords({ phase: 'live', ...free }, 'Rover')).toEqual({ text: 'Live · Rover', tone: 'good' });
  for (const phase of ['connecting', 'opening', 'silent'] as const)
    expect(watchWords({ phase, ...free }, 'Rover').text).not.toMatch(/^Live/);
  const obstacles = ['relay-unreachable', 'no-broadcast', 'not-a-broadcast', 'refused', 'lost'] as const;
  for (const obstacle of obstacles) {
    const { text, tone } = watchWords({ phase: 'waiting', obstacle, detail: '' }, null);
    expect(text).not.toMatch(/^Live/);
    expect(tone).not.toBe('good');
  }
});
