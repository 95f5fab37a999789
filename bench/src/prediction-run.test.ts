import { someOf } from '@farpoint/network-sim/cases';
import { expect, test } from 'vitest';
import { meetsTargets } from './prediction.ts';
import { type DriveSpec, driveOnce } from './prediction-run.ts';

const spec: DriveSpec = {
  ...{ base: 'sim', loopMs: 150, upShare: 0.5, jitterMs: 0, loss: 0, noiseM: 0, rounds: 2, seed: 1 },
};

test('over a loop of 150 ms at 1 m/s the view is where the robot is, from a model that was not given', () => {
  const result = driveOnce(spec);
  expect(meetsTargets(result), JSON.stringify(result)).toBe(true);
});

test('a session that begins with a turn is predicted from what the robot says of itself, each time alike', () => {
  for (const other of someOf([{ jitterMs: 15, loss: 0.02 }, {}, { seed: 2, noiseM: 0.005 }])) {
    const drive = () => driveOnce({ ...spec, rounds: 1, ...other });
    const result = drive();
    expect(result.firstTurn.errorDeg.p95, JSON.stringify(other)).toBeLessThanOrEqual(2);
    expect(drive()).toEqual(result);
  }
});

test('a base that lags, ignores small commands and is slower than told is learnt as well', () => {
  const { ratioM, ratioDeg, correctionM, model } = driveOnce({ ...spec, base: 'sluggish' });
  expect(Math.min(ratioM, ratioDeg)).toBeGreaterThan(3);
  expect(correctionM).toBeLessThanOrEqual(0.03);
  expect((model.linear as { gain: number }).gain).toBeCloseTo(0.85, 1);
});

test('jitter and loss do not tear the view about', () => {
  const { ratioM, correctionM } = driveOnce({ ...spec, jitterMs: 20, loss: 0.05 });
  expect(ratioM).toBeGreaterThan(2);
  expect(correctionM).toBeLessThanOrEqual(0.03);
});
