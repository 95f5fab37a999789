import { expect, test } from 'vitest';
import { Scenario } from './scenario.ts';

test('an operator connects and drives', () => {
  using scenario = new Scenario();
  scenario.driving();
  expect(scenario.robot.base.state.pose.position.x).toBeGreaterThan(0.3);
});

test('what fails in a scenario fails its test, and what never ends is given up', async () => {
  using scenario = new Scenario();
  const in30Ms = (error: Error | null): Promise<void> => {
    const { promise, resolve, reject } = Promise.withResolvers<void>();
    setTimeout(() => (error === null ? resolve() : reject(error)), 30);
    return promise;
  };
  const beganMs = scenario.nowMs;
  expect(await scenario.happens(() => in30Ms(null))).toBe(beganMs + 30);
  const failure = new Error('there is no such robot');
  await expect(scenario.happens(() => in30Ms(failure))).rejects.toBe(failure);
  await expect(scenario.happens(() => new Promise(() => undefined), 100)).rejects.toThrow('within 100 ms');
  expect(scenario.nowMs).toBe(beganMs + 160);
});
