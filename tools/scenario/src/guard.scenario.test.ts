/** The obstacle guard and the fence hold a robot whose driver does not stop. */
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { GuardSight } from './guard-sight.ts';
import { Scenario } from './scenario.ts';
import { walledOffice } from './worlds.ts';

const WALL_M = 1.2;

describe('a wall', () => {
  let sight: GuardSight;
  beforeEach(async () => {
    sight = await GuardSight.open(walledOffice(WALL_M));
  });
  afterEach(() => {
    sight[Symbol.dispose]();
  });

  function drivenAtWall(): Scenario {
    const scenario = new Scenario({ world: walledOffice(WALL_M), sight });
    const driver = scenario.connected();
    scenario.run(500);
    driver.hand.push(1);
    scenario.run(15_000);
    return scenario;
  }

  test('holds the robot before it, and its driver is told why', () => {
    using scenario = drivenAtWall();
    const { base, core } = scenario.robot;
    const room = base.clearanceAt(base.state.pose.position.x, base.state.pose.position.y);
    expect(room).toBeGreaterThan(0.02);
    expect(room).toBeLessThan(0.35);
    expect(scenario.robot.wheels.speed).toBe(0);
    expect(core.driving.status.state(core.host.now()).reasons).toContain('obstacle');
    expect(scenario.operators[0]?.client.telemetry?.motion?.reasons).toContain('obstacle');
    expect(scenario.robot.counters.interventions.get('obstacle')).toBe(1);
    expect(scenario.log.text).toContain('obstacle');
    expect(base.state.collision).toBe(false);
  });

  test('that appears in a blind camera’s place: the robot does not drive on what it saw before', () => {
    using scenario = new Scenario({ world: walledOffice(WALL_M), sight });
    const driver = scenario.connected();
    scenario.run(500);
    driver.hand.push(0.5);
    scenario.until(() => scenario.robot.wheels.speed > 0.1);
    sight.sees = false;
    scenario.run(10_000);
    expect(scenario.robot.wheels.speed).toBe(0);
    expect(scenario.robot.base.state.collision).toBe(false);
  });
});

describe('a fence', () => {
  test.each([1, 2, 3])('is not crossed, however long the driver holds on (link %i)', (seed) => {
    using scenario = new Scenario({
      ...{ seed, args: ['--fence-radius-m', '2'] },
      link: { delayMs: 20 * seed, loss: 0.01 * (seed - 1) },
    });
    const driver = scenario.connected();
    scenario.run(100);
    driver.hand.push(1);
    scenario.run(20_000);
    const { pose } = scenario.robot.base.state;
    const away = Math.hypot(pose.position.x, pose.position.y);
    expect(away).toBeGreaterThan(1);
    expect(away).toBeLessThan(2);
    expect(scenario.robot.wheels.speed).toBe(0);
    expect(driver.client.telemetry?.motion?.reasons).toContain('fence');
  });
});
