import { afterEach, expect, test } from 'vitest';
import { captionLines } from './capture-words.ts';
import { speak } from './language.ts';

const facts = {
  epochMs: Date.UTC(2026, 10, 30, 11, 12, 5, 900),
  robot: 'Rover',
  heard: true,
  stopped: false,
  figures: 'Driving · 0.50 m/s · 80 ms',
};

afterEach(() => speak('en'));

test('a picture says when it was taken, of which robot, and its main figures', () => {
  expect(captionLines(facts)).toEqual(['2026-11-30 11:12:05 UTC · Rover', 'Driving · 0.50 m/s · 80 ms']);
  expect(captionLines({ ...facts, stopped: true })[1]).toBe('EMERGENCY STOP · Driving · 0.50 m/s · 80 ms');
});

test('a picture that is not live says so, without figures', async () => {
  expect(captionLines({ ...facts, heard: false })).toEqual(['2026-11-30 11:12:05 UTC · Rover · NOT LIVE']);
  expect(captionLines({ ...facts, robot: null, heard: false, stopped: true })).toEqual([
    '2026-11-30 11:12:05 UTC · no robot · NOT LIVE',
    'EMERGENCY STOP',
  ]);
  await speak('de');
  expect(captionLines({ ...facts, heard: false })[0]).toContain('NICHT LIVE');
});
