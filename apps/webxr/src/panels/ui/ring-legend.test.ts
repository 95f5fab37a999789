import { describe, expect, test } from 'vitest';
import { ringBar, ringCaption, ringTicks } from './legend.ts';

describe('the legend of rings', () => {
  test('says how many there are, and whether that is known', () => {
    expect(ringCaption(null)).toBe('no rings found yet');
    expect(ringCaption({ elevations: [0, 0.1], from: 'robot' })).toBe('2 rings');
    expect(ringCaption({ elevations: [0, 0.1], from: 'points' })).toBe('2 rings, estimated');
  });

  test('has a band for each ring, and whole numbers below their middles', () => {
    expect(ringBar(0, () => 'red')).toBe('none');
    expect(ringBar(4, () => 'red').match(/red/g)).toHaveLength(4);
    expect(ringBar(4, () => 'red')).toContain('red 25.00% 50.00%');
    expect(ringTicks(16)).toEqual(
      [0, 5, 10, 15].map((ring) => ({ place: (ring + 0.5) / 16, text: String(ring) })),
    );
    for (let count = 0; count <= 256; count++) {
      for (const { place, text } of ringTicks(count)) {
        expect(Math.floor(place * count)).toBe(Number(text));
        expect(place).toBeLessThan(1);
      }
    }
    expect(ringTicks(2).map(({ text }) => text)).toEqual(['0', '1']);
  });
});
