import { expect, test } from 'vitest';
import { GoogCcController } from './goog-cc-controller.ts';
import { runScenario, type Scenario, utilisation } from './sim/index.ts';

const SCENARIO: Scenario = {
  name: 'steady',
  durationMs: 15_000,
  capacity: [{ fromMs: 0, bitsPerSecond: 20e6 }],
  rttMs: 42.4,
};

test('libwebrtc’s controller runs in the simulator: finds a steady link within a second', () => {
  const outcome = runScenario(SCENARIO, () => new GoogCcController());
  const [flow] = outcome.media as [(typeof outcome.media)[0]];
  expect(utilisation(outcome, flow, 1000, 3000)).toBeGreaterThan(0.7);
  expect(utilisation(outcome, flow, 3000, 15_000)).toBeGreaterThan(0.5);
});

test('the same run gives the same numbers', () => {
  const short = { ...SCENARIO, durationMs: 3000 };
  const runs = [1, 2].map(() => runScenario(short, () => new GoogCcController()).media[0]!.target);
  expect(runs[0]).toEqual(runs[1]);
});
