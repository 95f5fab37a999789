import { expect, test } from 'vitest';
import { DEFAULT_HEADSET } from './headset-settings.ts';
import { needsReload } from './settings-change.ts';

const stored = {
  signaling: '',
  tokens: new Map([['wss://a', 'secret']]),
  name: 'Ada',
  pointScale: 1,
  cues: true,
};

test('how everything looks, sounds and turns counts at once', () => {
  expect(needsReload(stored, { ...stored })).toBe(false);
  const look = { pointScale: 2.5, cues: false, synchronised: false, mapTiles: 'https://a/{z}/{x}/{y}' };
  expect(needsReload(stored, { ...stored, ...look })).toBe(false);
  expect(needsReload(stored, { ...stored, headset: { ...DEFAULT_HEADSET, driveHand: 'left' } })).toBe(false);
});

test('another service, token or name needs a new connection', () => {
  expect(needsReload(stored, { ...stored, name: 'Grace' })).toBe(true);
  expect(needsReload(stored, { ...stored, signaling: 'wss://b' })).toBe(true);
  expect(needsReload(stored, { ...stored, tokens: new Map([['wss://a', 'other']]) })).toBe(true);
  expect(needsReload(stored, { ...stored, tokens: new Map() })).toBe(true);
});

test('an empty value and an absent one are the same, in any order', () => {
  const { signaling: _, ...others } = stored;
  expect(needsReload(stored, others)).toBe(false);
  const more = new Map([['wss://b', ''], ...stored.tokens]);
  expect(needsReload(stored, { ...stored, tokens: more })).toBe(false);
});
