import { effect } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { DEFAULT_HEADSET } from './headset/headset-settings.ts';
import { liveSettings } from './live-settings.ts';
import { readSettings } from './settings.ts';

const PAGE = { protocol: 'http:', hostname: 'localhost', host: 'localhost:1', isDevServer: false };
const settings = () => liveSettings(readSettings(new URLSearchParams('sync=0'), { name: 'Ada' }, PAGE));

test('are those that the page began with, until others are saved', () => {
  const live = settings();
  expect(live).toMatchObject({ name: 'Ada', synchronised: false, cues: true });
  expect({ ...live.headset }).toEqual(DEFAULT_HEADSET);
  const { headset } = live;
  live.apply({ synchronised: true, cues: false, headset: { ...DEFAULT_HEADSET, turn: 'smooth' } });
  expect(live).toMatchObject({ name: 'Ada', synchronised: true, cues: false });
  expect(headset.turn).toBe('smooth');
  live.apply({});
  expect(live).toMatchObject({ synchronised: true, cues: true });
  expect(headset.turn).toBe('snap');
});

test('tell effects of what has changed', () => {
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
