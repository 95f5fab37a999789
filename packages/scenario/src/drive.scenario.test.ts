import { expect, test } from 'vitest';
import { Scenario } from './scenario.ts';
import { virtualTime } from './virtual-time.ts';

test('an operator connects and drives', () => {
  using time = virtualTime();
  using scenario = new Scenario(time.advance);
  scenario.driving();
  expect(scenario.robot.base.state.pose.position.x).toBeGreaterThan(0.3);
});
