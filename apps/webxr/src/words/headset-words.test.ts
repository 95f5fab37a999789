import { expect, test } from 'vitest';
import { HEADSET_VIEWS } from '../ground/headset-settings.ts';
import { viewFact, viewHint, viewNotice } from './headset-words.ts';

test('says which view is shown, unless it is the usual one, and the scale of a model', () => {
  expect(HEADSET_VIEWS.map((view) => viewFact(view, 0.05))).toEqual([
    null,
    'Over the shoulder',
    'Tabletop 1:20',
  ]);
  expect(viewFact('tabletop', 1)).toBe('Tabletop 1:1');
});

test('says in each view which hand drives', () => {
  for (const view of HEADSET_VIEWS) expect(viewHint(view, 'left')).toContain('squeeze left: drive');
});

test('says which view has begun', () => {
  expect(viewNotice('over-shoulder')).toBe('View in the headset: over the shoulder');
});
