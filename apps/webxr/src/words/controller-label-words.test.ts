import { expect, test } from 'vitest';
import { HEADSET_VIEWS } from '../ground/headset-settings.ts';
import { controlWords, type LabelFacts } from './controller-label-words.ts';

const idle: LabelFacts = {
  live: true,
  chosen: true,
  watches: false,
  otherDrives: false,
  latched: false,
  mayRelease: true,
  gripped: false,
  mustLetGo: false,
  menu: false,
  mayPoint: false,
  aims: null,
  view: 'first-person',
  pictures: false,
  speaks: false,
  turns: true,
  nextRobot: null,
};
const driver = (facts: Partial<LabelFacts>) => controlWords({ ...idle, ...facts }, 'right', true);
const viewer = (facts: Partial<LabelFacts>) => controlWords({ ...idle, ...facts }, 'left', false);

test('names what each control does now, on either hand', () => {
  expect(driver({})).toEqual({
    grip: 'Squeeze: drive',
    stick: 'Stick: steer, with grip',
    stickPress: null,
    trigger: null,
    lower: 'A: menu',
    upper: 'B: STOP',
  });
  expect(viewer({})).toEqual({
    grip: null,
    stick: 'Stick: turn the view',
    stickPress: 'Press stick: recentre',
    trigger: null,
    lower: 'X: next view',
    upper: 'Y: STOP',
  });
  for (const view of HEADSET_VIEWS) expect(driver({ view }).grip).toBe('Squeeze: drive');
  expect(driver({ nextRobot: 'Two' }).stickPress).toBe('Press stick: Two');
  expect(viewer({ turns: false }).stick).toBeNull();
});

test('for a left-handed operator the letters change hands with what they do', () => {
  expect(controlWords(idle, 'left', true)).toMatchObject({ lower: 'X: menu', upper: 'Y: STOP' });
  expect(controlWords(idle, 'right', false)).toMatchObject({ lower: 'A: next view', upper: 'B: STOP' });
});

test('the grip says how to drive, or why it does not', () => {
  expect(driver({ gripped: true })).toMatchObject({ grip: 'Let go: robot stops', lower: null });
  expect(driver({ mustLetGo: true }).grip).toBe('Let go, then squeeze');
  expect(driver({ otherDrives: true }).grip).toBe('Someone drives: see menu');
  expect(driver({ watches: true })).toMatchObject({ grip: 'You may only watch', stick: null });
  expect(driver({ live: false }).grip).toBeNull();
});

test('while STOP is on, the triggers say how to release it; who may not release it reads nothing there', () => {
  const latched = { latched: true, pictures: true };
  for (const words of [driver(latched), viewer(latched)]) {
    expect(words.grip).toBeNull();
    expect(words.trigger).toBe('Hold 1 s: release STOP');
    expect(words.upper).toContain('STOP is on');
  }
  expect(driver({ latched: true, mayRelease: false }).trigger).toBeNull();
});

test('a trigger enlarges, holds the model or speaks', () => {
  expect(driver({ pictures: true }).trigger).toBe('Trigger: enlarge picture');
  expect(viewer({ view: 'tabletop' }).trigger).toBe('Trigger: hold the model');
  expect(viewer({ gripped: true, speaks: true }).trigger).toBe('Trigger: speak');
  expect(driver({ gripped: true, pictures: true }).trigger).toBeNull();
});

test('the other hand’s grip aims at the floor where others see it, also while the first one drives; a trigger after the menu', () => {
  expect(viewer({ mayPoint: true }).grip).toBe('Squeeze: point at floor');
  expect(viewer({ mayPoint: true, gripped: true, aims: 'grip' }).grip).toBe('Let go: point there');
  expect(viewer({ mayPoint: true, menu: true }).grip).toBeNull();
  expect(driver({ mayPoint: true }).grip).toBe('Squeeze: drive');
  for (const wordsOf of [driver, viewer])
    expect(wordsOf({ mayPoint: true, aims: 'trigger', latched: true }).trigger).toBe('Trigger: point there');
});

test('in the menu both hands choose, the grip drives on, and STOP stays STOP', () => {
  for (const words of [driver({ menu: true }), viewer({ menu: true })]) {
    expect(words).toMatchObject({ trigger: 'Trigger: choose', stick: 'Stick: up and down' });
    expect(words.upper).toContain('STOP');
    expect(words.lower).toContain('close the menu');
  }
  expect(driver({ menu: true }).grip).toBe('Squeeze: close, drive');
  expect(driver({ menu: true, latched: true }).grip).toBeNull();
  expect(driver({ live: false, chosen: false })).toMatchObject({ grip: null, lower: 'A: menu', upper: null });
});
