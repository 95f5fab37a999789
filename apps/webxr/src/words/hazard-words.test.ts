import { expect, test } from 'vitest';
import { hazardHint, hazardLegendWords, hazardNotice } from './hazard-words.ts';

const heights = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15, slope: 0.01 };

test('the legend says which heights are tinted', () => {
  expect(hazardLegendWords(heights)).toEqual({
    hit: 'would hit: 0.04–1.10 m',
    drop: 'drop: below −0.15 m',
  });
  expect(hazardHint(true, heights)).toBe('Red: would hit  violet: drop');
  expect(hazardNotice(true, heights)).toContain('Red');
});

test('of a robot that does not say them, nothing is claimed', () => {
  expect(hazardLegendWords(null)).toEqual({ unknown: 'hazards: robot’s height unknown' });
  expect(hazardHint(true, null)).toBe('No hazard tint');
  expect(hazardNotice(true, null)).toContain('cannot');
});

test('nothing is said of what is switched off', () => {
  expect(hazardHint(false, heights)).toBe(null);
  expect(hazardNotice(false, heights)).toBe('Hazards are not tinted.');
});
