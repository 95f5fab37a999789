import { afterEach, expect, test } from 'vitest';
import { STANDARD_MAP } from '../take/drive/controller-map.ts';
import { DEFAULT_KEYS } from '../take/drive/key-map.ts';
import { speak } from './language.ts';
import { TOUR_STEPS, type TourFacts, tourLine } from './tour-words.ts';

afterEach(() => speak('en'));

const facts: TourFacts = {
  keys: DEFAULT_KEYS,
  controller: null,
  touch: false,
  watches: false,
  otherDrives: false,
  stop: null,
  heldBy: null,
};
const mine = {
  why: 'You pressed STOP.',
  release: 'Hold the release control.',
  mayRelease: true,
  heard: true,
};
const pad = { name: 'Pad', map: STANDARD_MAP, isStandard: true };

test('names the keys that are set now', () => {
  expect(tourLine('grip', facts)).toBe(
    'Step 1 of 4: hold Space, Left Shift or Right Shift: this is the grip. The robot stops when you let go.',
  );
  expect(tourLine('drive', facts)).toBe(
    'Step 2 of 4: with the grip held, press W, A, S or D: the robot drives.',
  );
  const keys = { ...DEFAULT_KEYS, forward: ['KeyI'], grip: ['KeyK'], estop: ['KeyX', 'Backspace'] };
  expect(tourLine('grip', { ...facts, keys })).toContain('hold K: this is the grip');
  expect(tourLine('drive', { ...facts, keys })).toContain('press I, A, S or D');
  expect(tourLine('stop', { ...facts, keys })).toContain('press X or Backspace, or the STOP button');
  expect(tourLine('release', { ...facts, stop: mine })).toContain('hold R, or “Hold to release”');
  expect(tourLine('grip', { ...facts, keys: { ...keys, grip: [] } })).toContain('your controller');
});

test('names the buttons and the stick of a controller that can drive', () => {
  const with_ = { ...facts, controller: pad };
  expect(tourLine('grip', with_)).toContain('hold Space or LB (Pad): this is the grip');
  expect(tourLine('drive', with_)).toContain('press W, A, S, D or left stick ↕ (Pad)');
  expect(tourLine('stop', with_)).toContain('press X or B (Pad), or the STOP button');
  expect(tourLine('release', { ...with_, stop: mine })).toContain('hold R or Y (Pad)');
});

test('names no key to a finger', () => {
  for (const step of TOUR_STEPS)
    expect(tourLine(step, { ...facts, touch: true, stop: step === 'release' ? mine : null })).not.toMatch(
      /Space|Shift| [WXR]\b/,
    );
});

test('says what keeps a step from being done, and asks for nothing else', () => {
  const stop = {
    why: 'Ann pressed STOP.',
    release: 'Only a supervisor releases it.',
    mayRelease: false,
    heard: true,
  };
  for (const step of TOUR_STEPS)
    expect(tourLine(step, { ...facts, stop })).toMatch(
      /the emergency stop is on\. Ann pressed STOP\. Only a supervisor releases it\.$/,
    );
  for (const step of ['grip', 'drive'] as const) {
    expect(tourLine(step, { ...facts, otherDrives: true })).toContain('Someone else is driving');
    expect(tourLine(step, { ...facts, watches: true, otherDrives: true })).toContain('lets you watch');
  }
  expect(tourLine('drive', { ...facts, heldBy: 'Held: something is in the way' })).toMatch(
    /: the robot drives\. The robot does not move now\. Held: something is in the way\.$/,
  );
});

test('is in the page’s language', async () => {
  await speak('de');
  expect(tourLine('grip', facts)).toMatch(
    /^Schritt 1 von 4: Halten Sie Leertaste, Umschalt links oder Umschalt rechts: Das ist der Griff\./,
  );
  expect(tourLine('done', facts)).toMatch(/^Das war alles/);
});
