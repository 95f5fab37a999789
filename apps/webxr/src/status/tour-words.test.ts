import { expect, test } from 'vitest';
import { DEFAULT_KEYS } from '../drive/key-map.ts';
import { type TourFacts, tourLine, tourWords } from './tour-words.ts';

const facts: TourFacts = {
  ...{ keys: DEFAULT_KEYS, oneHanded: false, touch: false, otherDrives: false },
  ...{ stop: null, heldBy: null },
};
const mine = { why: 'You pressed STOP.', release: 'Hold the release control.', mayRelease: true };

test('names the keys that were chosen', () => {
  expect(tourLine('grip', facts)).toMatch(/^Step 1 of 4: hold Space, Left Shift or Right Shift: the grip\./);
  expect(tourLine('drive', facts)).toBe(
    'Step 2 of 4: with the grip held, press W, A, S or D: the robot drives.',
  );
  const keys = { ...DEFAULT_KEYS, forward: ['KeyI'], grip: ['KeyK'], estop: ['KeyX', 'Backspace'] };
  expect(tourLine('grip', { ...facts, keys })).toContain('hold K: the grip');
  expect(tourLine('drive', { ...facts, keys })).toContain('press I, A, S or D');
  expect(tourLine('stop', { ...facts, keys })).toContain('press X or Backspace or the STOP button');
  expect(tourLine('release', { ...facts, stop: mine })).toContain('hold R or “Hold to release”');
  expect(tourLine('grip', { ...facts, oneHanded: true })).toContain('hold W, A, S or D');
  expect(tourLine('grip', { ...facts, keys: { ...keys, grip: [] } })).toContain('your controller');
});

test('names no key to a finger', () => {
  for (const step of ['grip', 'drive', 'stop', 'release'] as const)
    expect(tourLine(step, { ...facts, touch: true, stop: step === 'release' ? mine : null })).not.toMatch(
      /Space|Shift| [WXR] /,
    );
});

test('asks for nothing that cannot be done now', () => {
  const stop = { why: 'Ann pressed STOP.', release: 'Only a supervisor releases it.', mayRelease: false };
  for (const step of ['grip', 'drive', 'stop', 'release'] as const)
    expect(tourLine(step, { ...facts, stop })).toContain('Ann pressed STOP. Only a supervisor releases it.');
  expect(tourLine('grip', { ...facts, otherDrives: true })).toContain('Someone else is driving');
  expect(tourLine('drive', { ...facts, heldBy: 'Held: something is in the way' })).toContain(
    'It does not move now. Held: something is in the way.',
  );
  expect(tourLine('done', facts)).toBe(tourWords.done);
});
