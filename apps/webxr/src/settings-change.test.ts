import { expect, test } from 'vitest';
import { DEFAULT_HEADSET } from './headset/headset-settings.ts';
import { needsReload } from './settings-change.ts';

const stored = {
  signaling: '',
  tokens: new Map([['wss://a', 'secret']]),
  name: 'Ada',
  pointScale: 1,
  cues: true,
  clips: false,
};

test('how everything looks, sounds and turns counts at once', () => {
  expect(needsReload(stored, { ...stored })).toBe(false);
  expect(
    needsReload(stored, { ...stored, pointScale: 2.5, cues: false, clips: true, synchronised: false }),
  ).toBe(false);
  expect(needsReload(stored, { ...stored, headset: { ...DEFAULT_HEADSET, turn: 'smooth' } })).toBe(false);
});

test('everything else needs the page to start anew', () => {
  expect(needsReload(stored, { ...stored, name: 'Grace' })).toBe(true);
  expect(needsReload(stored, { ...stored, headset: { ...DEFAULT_HEADSET, driveHand: 'left' } })).toBe(true);
  expect(needsReload(stored, { ...stored, tokens: new Map([['wss://a', 'other']]) })).toBe(true);
  expect(needsReload(stored, { ...stored, tokens: new Map() })).toBe(true);
});

test('what is empty and what is absent are the same, in any order', () => {
  const { name, ...others } = stored;
  expect(needsReload({ ...others, name, mapTiles: undefined }, { name, ...others, mapTiles: '' })).toBe(
    false,
  );
  const withEmpty = new Map([...stored.tokens, ['wss://b', '']]);
  expect(needsReload(stored, { ...stored, tokens: withEmpty })).toBe(false);
});
