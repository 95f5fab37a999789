import { effect } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { DEFAULT_HEADSET } from './headset-settings.ts';
import { liveSettings } from './live-settings.ts';
import { readSettings } from './settings.ts';

const PAGE = { protocol: 'http:', hostname: 'localhost', host: 'localhost:1', isDevServer: false };
const TILES = 'https://tiles.example/{z}/{x}/{y}.png';
const settings = () =>
  liveSettings(readSettings(new URLSearchParams(), { name: 'Ada', synchronised: false }, PAGE), PAGE);

test('are those that the page began with, until others are saved', () => {
  const live = settings();
  expect(live).toMatchObject({ name: 'Ada', synchronised: false, cues: true, clips: false, mapTiles: null });
  expect({ ...live.headset }).toEqual(DEFAULT_HEADSET);
  const { headset } = live;
  live.apply({
    synchronised: true,
    cues: false,
    clips: true,
    mapTiles: TILES,
    headset: { ...DEFAULT_HEADSET, turn: 'smooth' },
  });
  expect(live).toMatchObject({ name: 'Ada', synchronised: true, cues: false, clips: true });
  expect(live.mapTiles).toEqual({ template: TILES, attribution: null, host: 'tiles.example' });
  expect(headset.turn).toBe('smooth');
  live.apply({});
  expect(live).toMatchObject({ synchronised: true, cues: true, clips: false, mapTiles: null });
  expect(headset.turn).toBe('snap');
});

test('tell effects what has changed', () => {
  const live = settings();
  const seen: unknown[] = [];
  effect(() => {
    seen.push([live.synchronised, live.headset.snapDegrees]);
  });
  live.apply({ synchronised: false, cues: false, headset: DEFAULT_HEADSET });
  live.apply({ synchronised: true, headset: { ...DEFAULT_HEADSET, snapDegrees: 45 } });
  expect(seen.at(0)).toEqual([false, 30]);
  expect(seen.at(-1)).toEqual([true, 45]);
});

test('the same map’s tiles are kept', () => {
  const live = settings();
  let changes = -1;
  effect(() => {
    void live.mapTiles;
    changes++;
  });
  live.apply({ mapTiles: TILES });
  live.apply({ mapTiles: TILES, cues: false });
  expect(changes).toBe(1);
});
