import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { changed, DEFAULT_LAYOUT, type Layout, layoutText, moved, parseLayout, placed } from './layout.ts';

const available = ['speed', 'map', 'battery', 'extra'].map((id) => ({
  ...{ id, size: 'small' as const, title: `Of ${id}` },
  shown: id !== 'extra',
}));
const ids = (layout: Layout) => placed(layout, available).map(({ id }) => id);

describe('the layout', () => {
  test('that is stored comes back; anything else gives the defaults', () => {
    const layout = changed({ ...DEFAULT_LAYOUT, windowS: 600 }, available, 'map', { size: 'large' });
    expect(parseLayout(layoutText(layout))).toEqual(layout);
    for (const text of [null, '', '7', '{}', '{"version":2}', layoutText(layout).replace('large', 'huge')])
      expect(parseLayout(text)).toEqual(DEFAULT_LAYOUT);
    fc.assert(
      fc.property(fc.oneof(fc.json(), fc.string()), (text) => {
        expect(() => placed(parseLayout(text), available)).not.toThrow();
      }),
      { seed: 1, numRuns: 300 },
    );
  });

  test('moves a tile past the ones that are shown, and not beyond the ends', () => {
    const once = moved(DEFAULT_LAYOUT, available, 'battery', -1);
    expect(ids(once)).toEqual(['speed', 'battery', 'map', 'extra']);
    expect(ids(moved(once, available, 'speed', -1))).toEqual(ids(once));
    expect(ids(moved(once, available, 'map', 1))).toEqual(ids(once));
    const hidden = changed(once, available, 'battery', { shown: false });
    expect(ids(moved(hidden, available, 'map', -1))).toEqual(['map', 'battery', 'speed', 'extra']);
    expect(moved(once, available, 'nothing', 1)).toBe(once);
  });

  test('keeps the tiles of another robot, and adds new ones at the end', () => {
    const ofAnother = changed(DEFAULT_LAYOUT, [{ id: 'arm', size: 'medium', shown: true }], 'arm', {
      shown: false,
    });
    const here = changed(ofAnother, available, 'map', { shown: false });
    expect(ids(here)).toEqual(['speed', 'map', 'battery', 'extra']);
    expect(here.tiles.at(-1)).toEqual({ id: 'arm', size: 'medium', shown: false });
    const more = [...available, { id: 'new', size: 'medium' as const, shown: true }];
    expect(placed(here, more).at(-1)?.id).toBe('new');
  });

  test('is bounded', () => {
    let layout = DEFAULT_LAYOUT;
    for (let i = 0; i < 400; i++)
      layout = changed(layout, [{ id: `tile ${i}`, size: 'small', shown: true }], `tile ${i}`, {
        shown: false,
      });
    expect(layout.tiles.length).toBe(160);
    expect(parseLayout(layoutText(layout))).toEqual(layout);
  });
});
