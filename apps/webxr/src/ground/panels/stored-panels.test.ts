import fc from 'fast-check';
import { expect, test } from 'vitest';
import { MOST_PLACEMENTS, PanelPlacements } from './panel-placements.ts';
import { parsePlacements, placementsText } from './stored-panels.ts';

const at = (x: number) => ({ x, y: 0, width: 300 });

test('the panel that was touched last is on top, and is stored with its place', () => {
  let stored = '';
  const placements = new PanelPlacements(new Map(), (all) => {
    stored = placementsText(all);
  });
  placements.place('video:Front', at(0));
  placements.place('video:Rear', at(0.5));
  placements.place('video:Rear', at(0.7), false);
  expect([...parsePlacements(stored)]).toEqual([
    ['video:Front', at(0)],
    ['video:Rear', at(0.5)],
  ]);
  placements.raise('video:Front');
  placements.raise('video:Left');
  expect([...placements.all.value.keys()]).toEqual(['video:Rear', 'video:Front']);
  expect([...parsePlacements(stored).keys()]).toEqual(['video:Rear', 'video:Front']);
  placements.reset();
  expect([placements.all.value.size, parsePlacements(stored).size]).toEqual([0, 0]);
});

test('keeps no more places than it reads', () => {
  const placements = new PanelPlacements(new Map(), () => undefined);
  for (let i = 0; i < MOST_PLACEMENTS + 5; i++) placements.place(`video:${i}`, at(0));
  expect(parsePlacements(placementsText(placements.all.value)).size).toBe(MOST_PLACEMENTS);
});

test('what it cannot use puts every panel into its usual place', () => {
  const good = '{"panels":[{"name":"video:Front","x":0,"y":1,"width":300}]}';
  expect(parsePlacements(good).size).toBe(1);
  const bad = [
    null,
    '',
    '{',
    '[]',
    '{"panels":{}}',
    good.replace('300', '-1'),
    good.replace('"x":0', '"x":2'),
    good.replace('"y":1', '"y":"1"'),
  ];
  for (const text of bad) expect(parsePlacements(text).size).toBe(0);
  fc.assert(fc.property(fc.oneof(fc.string(), fc.json()), (text) => parsePlacements(text) instanceof Map));
});
