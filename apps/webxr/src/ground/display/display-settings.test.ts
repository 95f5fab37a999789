import fc from 'fast-check';
import { expect, test } from 'vitest';
import { parseDisplay, shownDisplay, TEXT_SCALES } from './display-settings.ts';

const NOTHING = { light: false, moreContrast: false, reducedMotion: false };

test('nothing is stored: the system decides', () => {
  const settings = parseDisplay(null);
  expect(settings).toEqual({
    theme: 'system',
    textScale: 1,
    motion: 'system',
    language: 'system',
    awake: true,
  });
  expect(shownDisplay(settings, NOTHING)).toEqual({ theme: 'dark', motion: 'full', textScale: 1 });
  expect(shownDisplay(settings, { ...NOTHING, light: true, reducedMotion: true })).toEqual({
    theme: 'light',
    motion: 'reduced',
    textScale: 1,
  });
  expect(shownDisplay(settings, { ...NOTHING, light: true, moreContrast: true }).theme).toBe('contrast');
});

test('a choice comes before the system', () => {
  const stored = JSON.stringify({ theme: 'dark', textScale: 1.5, motion: 'full', awake: false });
  const settings = parseDisplay(stored);
  expect(settings.awake).toBe(false);
  const system = { light: true, moreContrast: true, reducedMotion: true };
  expect(shownDisplay(settings, system)).toEqual({ theme: 'dark', motion: 'full', textScale: 1.5 });
});

test('one wrong value does not lose the others', () => {
  const stored = JSON.stringify({ theme: 'pink', textScale: 100, motion: 'reduced' });
  expect(parseDisplay(stored)).toEqual({
    theme: 'system',
    textScale: 1,
    motion: 'reduced',
    language: 'system',
    awake: true,
  });
});

test('whatever is stored, the page has a theme and readable text', () => {
  fc.assert(
    fc.property(fc.oneof(fc.string(), fc.json()), (stored) => {
      const { theme, textScale } = shownDisplay(parseDisplay(stored), NOTHING);
      expect(['dark', 'light', 'contrast']).toContain(theme);
      expect(textScale).toBeGreaterThanOrEqual(TEXT_SCALES.least);
      expect(textScale).toBeLessThanOrEqual(TEXT_SCALES.most);
    }),
  );
});
