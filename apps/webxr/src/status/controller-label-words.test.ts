import { expect, test } from 'vitest';
import { HEADSET_VIEWS } from '../headset/rig-pose.ts';
import { controlWords, type LabelFacts } from './controller-label-words.ts';

const idle: LabelFacts = {
  ...{ live: true, chosen: true, watches: false, otherDrives: false, latched: false, atRobot: false },
  ...{ gripped: false, mustLetGo: false, menu: false, view: 'first-person', pictures: false },
  ...{ speaks: false, turns: true, nextRobot: null },
};
const driver = (facts: Partial<LabelFacts>) => controlWords({ ...idle, ...facts }, 'right', 'drives');
const viewer = (facts: Partial<LabelFacts>) => controlWords({ ...idle, ...facts }, 'left', 'views');

test('names what each control does now, on either hand', () => {
  expect(driver({})).toEqual({
    grip: 'Squeeze: drive',
    stick: 'Stick: steer, with the grip',
    ...{ stickPress: null, trigger: null, lower: 'A: menu', upper: 'B: STOP' },
  });
  expect(viewer({})).toEqual({
    ...{ grip: null, trigger: null, lower: 'X: next view', upper: 'Y: STOP' },
    ...{ stick: 'Stick: turn the view', stickPress: 'Press stick: recentre' },
  });
  expect(controlWords(idle, 'left', 'drives')).toMatchObject({ lower: 'X: menu', upper: 'Y: STOP' });
  for (const view of HEADSET_VIEWS) expect(driver({ view }).grip).toBe('Squeeze: drive');
  expect(driver({ nextRobot: 'Two' }).stickPress).toBe('Press stick: Two');
  expect(viewer({ turns: false }).stick).toBeNull();
});

test('the grip says how to drive, or why it does not', () => {
  expect(driver({ gripped: true }).grip).toBe('Let go: the robot stops');
  expect(driver({ mustLetGo: true }).grip).toBe('Let go, then squeeze: drive');
  expect(driver({ otherDrives: true }).grip).toBe('Someone else drives: see the menu');
  expect(driver({ watches: true })).toMatchObject({ grip: 'You only watch', stick: null });
  expect(driver({ live: false }).grip).toBeNull();
});

test('while STOP is on, the triggers say how to release it; at the robot only, they say nothing', () => {
  const latched = { latched: true, pictures: true };
  for (const words of [driver(latched), viewer(latched)]) {
    expect(words.grip).toBeNull();
    expect(words.trigger).toBe('Hold 1 s: release STOP');
    expect(words.upper).toContain('STOP is on');
  }
  expect(driver({ latched: true, atRobot: true }).trigger).toBeNull();
});

test('a trigger enlarges, holds the model, speaks or chooses', () => {
  expect(driver({ pictures: true }).trigger).toBe('Trigger at a picture: enlarge');
  expect(viewer({ view: 'tabletop' }).trigger).toBe('Trigger: hold the model');
  expect(viewer({ gripped: true, speaks: true }).trigger).toBe('Trigger: speak');
  expect(driver({ gripped: true, pictures: true }).trigger).toBeNull();
});

test('in the menu both hands choose, and STOP stays STOP; without a robot the menu is where robots are', () => {
  for (const words of [driver({ menu: true, latched: true }), viewer({ menu: true, latched: true })]) {
    expect(words).toMatchObject({ grip: null, trigger: 'Trigger: choose', stick: 'Stick: up, down' });
    expect(words.upper).toContain('STOP');
    expect(words.lower).toContain('close the menu');
  }
  const alone = driver({ live: false, chosen: false });
  expect(alone).toMatchObject({ grip: null, lower: 'A: menu, robots', upper: null });
});
