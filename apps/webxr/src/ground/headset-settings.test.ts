import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  DEFAULT_HEADSET,
  FRAME_RATES,
  HANDS,
  POSTURES,
  parseHeadset,
  RESOLUTIONS,
  SNAP_DEGREES,
  TURNS,
} from './headset-settings.ts';

test('keeps what is usable and replaces the rest by the defaults', () => {
  expect(parseHeadset(undefined)).toEqual(DEFAULT_HEADSET);
  expect(parseHeadset('left')).toEqual(DEFAULT_HEADSET);
  expect(parseHeadset({ turn: 'smooth', snapDegrees: 45, vignette: 0, driveHand: 'left' })).toEqual({
    ...DEFAULT_HEADSET,
    turn: 'smooth',
    snapDegrees: 45,
    vignette: 0,
    driveHand: 'left',
  });
  expect(parseHeadset({ turn: 'fast', snapDegrees: 400, vignette: Number.NaN, posture: 1 })).toEqual(
    DEFAULT_HEADSET,
  );
});

test('whatever the browser holds, the settings are within their bounds', () => {
  fc.assert(
    fc.property(
      fc.oneof(fc.jsonValue(), fc.object({ key: fc.constantFrom('turn', 'vignette') })),
      (value) => {
        const parsed = parseHeadset(value);
        const { turn, snapDegrees, vignette, posture, driveHand, frameRate, resolution } = parsed;
        expect(TURNS).toContain(turn);
        expect(POSTURES).toContain(posture);
        expect(HANDS).toContain(driveHand);
        expect(snapDegrees).toBeGreaterThanOrEqual(SNAP_DEGREES.least);
        expect(snapDegrees).toBeLessThanOrEqual(SNAP_DEGREES.most);
        expect(vignette).toBeGreaterThanOrEqual(0);
        expect(vignette).toBeLessThanOrEqual(1);
        expect(frameRate).toBeGreaterThanOrEqual(FRAME_RATES.least);
        expect(resolution).toBeLessThanOrEqual(RESOLUTIONS.most);
        expect(parsed.foveation).toBeGreaterThanOrEqual(0);
      },
    ),
    { seed: 3 },
  );
});
