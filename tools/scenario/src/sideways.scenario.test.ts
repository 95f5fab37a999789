/** A robot whose base goes sideways: the operator's hand, the link, the robot and its guard together. */
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { GuardSight } from './guard-sight.ts';
import { Scenario } from './scenario.ts';
import { walledOffice } from './worlds.ts';

const LATERAL = ['--max-lateral', '0.4'];
const WALL_M = 1.2;

describe('on a plain', () => {
  test('it goes to its side at the speed that the hand asks for, and stands when the grip opens', () => {
    using scenario = new Scenario({ args: LATERAL });
    const driver = scenario.connected();
    const { wheels, base } = scenario.robot;
    expect(driver.client.link.session.welcome?.limits.maxLateral).toBe(0.4);
    scenario.run(100);
    driver.hand.push(0, 0, 0.5);
    scenario.until(() => Math.abs(wheels.lateral - 0.2) < 1e-9);
    expect(wheels.speed).toBe(0);
    scenario.run(1000);
    const { pose, twist, yaw } = base.state;
    expect([twist.linear.x, twist.linear.y, yaw]).toEqual([0, expect.closeTo(0.2), 0]);
    expect([pose.position.x, pose.position.y > 0.15]).toEqual([0, true]);
    expect(driver.client.telemetry?.twist.linear.y).toBeCloseTo(0.2);
    driver.hand.letGo();
    scenario.run(300);
    expect([wheels.lateral, base.state.twist.linear.y]).toEqual([0, 0]);
  });

  test.each([
    ['STOP', (scenario: Scenario) => scenario.operators[0]?.client.estop()],
    ['silence', (scenario: Scenario) => scenario.operators[0]?.up.blackhole(true)],
  ])('%s ends a slanting motion: both axes stand at once', (_, happens) => {
    using scenario = new Scenario({ args: LATERAL });
    const driver = scenario.connected();
    const { wheels, base } = scenario.robot;
    scenario.run(100);
    driver.hand.push(0.3, 0, -1);
    scenario.until(() => Math.abs(wheels.lateral + 0.4) < 1e-9 && wheels.speed > 0.299);
    scenario.run(1100);
    happens(scenario);
    scenario.until(() => wheels.speed === 0, 600);
    expect(wheels.lateral).toBe(0);
    scenario.run(300);
    expect(base.state.twist.linear).toEqual({ x: 0, y: 0, z: 0 });
  });

  test('a robot that cannot takes the hand’s wish for the side as none', () => {
    using scenario = new Scenario();
    const driver = scenario.connected();
    expect(driver.client.link.session.welcome?.limits.maxLateral).toBe(undefined);
    scenario.run(100);
    driver.hand.push(0, 0, 1);
    scenario.run(2000);
    expect([scenario.robot.wheels.fastest, scenario.robot.base.state.pose.position.y]).toEqual([0, 0]);
  });
});

describe('a wall at its side', () => {
  const beside = () => {
    const world = walledOffice(WALL_M);
    return { ...world, start: { ...world.start, yaw: world.start.yaw - Math.PI / 2 } };
  };
  let sight: GuardSight;
  beforeEach(async () => {
    sight = await GuardSight.open(beside(), 1, Math.PI / 2);
  });
  afterEach(() => {
    sight[Symbol.dispose]();
  });

  test('holds it before the margin, and lets it go the other way', () => {
    using scenario = new Scenario({ world: beside(), sight, args: LATERAL });
    const driver = scenario.connected();
    const { base, wheels, core } = scenario.robot;
    const room = () => base.clearanceAt(base.state.pose.position.x, base.state.pose.position.y);
    scenario.run(500);
    driver.hand.push(0, 0, 1);
    scenario.until(() => wheels.lateral > 0.35);
    scenario.run(6000);
    expect(room()).toBeGreaterThan(0.02);
    expect(room()).toBeLessThan(0.35);
    expect([wheels.lateral, base.state.collision]).toEqual([0, false]);
    expect(core.driving.status.state(core.host.now()).reasons).toContain('obstacle');
    driver.hand.push(0, 0, -1);
    scenario.until(() => wheels.lateral < -0.2);
  });
});
