import { Random } from '@farpoint/network-sim';
import { describe, expect, test } from 'vitest';
import { type BaseModel, standingAt, stepBase, usualBase } from './base-model.ts';
import { CommandHistory } from './command-history.ts';
import { ModelFit } from './model-fit.ts';
import { TravelWindow } from './travel-window.ts';

const TRUE: BaseModel = {
  delayMs: 130,
  linear: { gain: 0.8, lagS: 0.3, rise: 1.2, fall: 2.5 },
  angular: { gain: 1.1, lagS: 0.05, rise: 3, fall: 3 },
};

/** Drives the true base for 20 s and fits along the way. @param noiseM of each reported interval */
function fitted(noiseM: number, outliers: number, wishes: (s: number) => [number, number]) {
  const random = new Random(7, 1);
  const commands = new CommandHistory(() => 150);
  const window = new TravelWindow();
  const fit = new ModelFit(usualBase(90), commands, window);
  const motion = standingAt();
  let travel = 0;
  let turn = 0;
  for (let ms = 0; ms < 20_000; ms++) {
    const [linear, angular] = wishes(ms / 1000);
    if (ms % 25 === 0) commands.add(ms, linear, angular);
    const heard = commands.indexAt(ms - TRUE.delayMs);
    const { yaw } = motion;
    stepBase(motion, TRUE, 0.8 * commands.linear(heard), 1.1 * commands.angular(heard), 0.001);
    travel += motion.linear * 0.001;
    turn += motion.yaw - yaw;
    if (ms % 50 === 49) {
      const slips = random.chance(outliers);
      const error = slips ? 0.2 : (random.next() - 0.5) * 2 * noiseM;
      window.add(ms - 49, ms + 1, travel + error, turn + error);
      fit.improve(0);
      travel = 0;
      turn = 0;
    }
  }
  return fit;
}

/** Where a base is so long after it was told to go at 1 m/s, or to turn at 0.8 rad/s. */
function afterStep(model: BaseModel, ms: number) {
  const [ahead, around] = [standingAt(), standingAt()];
  for (let now = model.delayMs; now < ms; now++) {
    stepBase(ahead, model, model.linear.gain, 0, 0.001);
    stepBase(around, model, 0, 0.8 * model.angular.gain, 0.001);
  }
  return { x: ahead.x, yaw: around.yaw };
}

const lively = (s: number): [number, number] => [s % 4 < 2 ? 1 : 0, s % 3 < 1 ? 0.8 : s % 3 < 2 ? -0.8 : 0];

describe('the fit', () => {
  test('finds delay, gain and lag of a base that it was not told of', () => {
    const { model } = fitted(0, 0, lively);
    // Lag and delay trade off a little; what they do together counts.
    expect(Math.abs(model.delayMs - TRUE.delayMs)).toBeLessThan(15);
    expect(Math.abs(model.linear.gain - TRUE.linear.gain)).toBeLessThan(0.03);
    expect(Math.abs(model.angular.gain - TRUE.angular.gain)).toBeLessThan(0.04);
    expect(Math.abs(model.linear.lagS - TRUE.linear.lagS)).toBeLessThan(0.1);
    expect(Math.abs(model.linear.rise - TRUE.linear.rise)).toBeLessThan(0.4);
  });

  test('noise and slipping wheels do not spoil where it expects the robot', () => {
    const { model } = fitted(0.002, 0.03, lively);
    expect(Math.abs(model.linear.gain - TRUE.linear.gain)).toBeLessThan(0.06);
    // Delay, lag and rise stand in for each other; what they lead to counts.
    for (const ms of [200, 400, 800]) {
      const [found, is] = [afterStep(model, ms), afterStep(TRUE, ms)];
      expect(Math.abs(found.x - is.x)).toBeLessThan(0.03);
      expect(Math.abs(found.yaw - is.yaw)).toBeLessThan(0.04);
    }
  });

  test('a robot that stands tells nothing, and nothing is changed', () => {
    const fit = fitted(0.0005, 0, () => [0, 0]);
    expect(fit.excited).toBe(false);
    expect(fit.model).toEqual(usualBase(90));
  });

  test('an axis that never moved keeps its model', () => {
    const { model } = fitted(0, 0, (s) => [s % 4 < 2 ? 1 : 0, 0]);
    expect(model.angular).toEqual(usualBase(90).angular);
    expect(Math.abs(model.linear.gain - TRUE.linear.gain)).toBeLessThan(0.03);
  });
});

test('the window’s memory is bounded', () => {
  const window = new TravelWindow();
  for (let i = 0; i < 5000; i++) window.add(i * 50, i * 50 + 50, 0.05, -0.01);
  expect(window.length).toBe(400);
  expect(window.travelled).toBeCloseTo(20, 6);
  expect(window.turned).toBeCloseTo(4, 6);
  expect(window.from[window.at(0)]).toBe(4600 * 50);
});
