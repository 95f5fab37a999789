/** What an operator and a robot make of a link that goes and comes back: sessions, leases, STOP. */
import { describe, expect, test } from 'vitest';
import { linkOf } from './faults/run-fault.ts';
import { SEEDS } from './faults/scenario-rig.ts';
import type { ScenarioOperator } from './operator.ts';
import { Scenario } from './scenario.ts';

function cut({ up, down }: ScenarioOperator, active: boolean): void {
  up.blackhole(active);
  down.blackhole(active);
}

describe('an outage', () => {
  test('the same session goes on, and the robot waits for a fresh hand', () => {
    for (const seed of [1, ...SEEDS]) {
      // The longest of them all is as long as one in a field test.
      const lastsMs = seed === 1 ? 33_000 : 1200 + 250 * seed;
      using scenario = new Scenario({ seed, link: linkOf(seed) });
      const driver = scenario.driving();
      const { robot } = scenario;
      cut(driver, true);
      scenario.run(lastsMs);
      expect([driver.client.phase, driver.link.interrupted, robot.wheels.speed]).toEqual(['live', true, 0]);
      const backMs = scenario.nowMs;
      cut(driver, false);
      scenario.until(() => !driver.link.interrupted, 4000);
      scenario.run(3000);
      expect(robot.wheels.fastestSince(backMs), scenario.log.text).toBe(0);
      expect([driver.link.sessionsOpened, robot.counters.sessionsOpened]).toEqual([1, 1]);
      driver.hand.letGo();
      scenario.run(1000);
      driver.hand.push(0.5);
      scenario.until(() => robot.wheels.speed === 0.5);
    }
  });

  test('of more than a minute ends the session on both sides, and another is opened', () => {
    using scenario = new Scenario();
    const driver = scenario.connected();
    cut(driver, true);
    scenario.run(59_000);
    expect([driver.client.phase, scenario.robot.sessions.size]).toEqual(['live', 1]);
    scenario.run(2000);
    expect([driver.client.phase === 'live', scenario.robot.counters.sessionsEnded.get('silent')]).toEqual([
      false,
      1,
    ]);
    cut(driver, false);
    scenario.until(() => driver.client.phase === 'live', 30_000);
    expect(driver.link.sessionsOpened).toBe(2);
  });

  test('of signaling alone is nobody’s: the robot goes on', () => {
    using scenario = new Scenario();
    const driver = scenario.driving();
    const fromMs = scenario.nowMs;
    scenario.signaling.ready = false;
    scenario.run(30_000);
    expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
    expect(driver.client.phase).toBe('live');
  });

  test('other addresses: the same session goes on over a new path', async () => {
    using scenario = new Scenario();
    const driver = scenario.driving();
    driver.link.renumber();
    scenario.run(400);
    expect(scenario.robot.wheels.speed).toBe(0);
    scenario.until(() => driver.link.interrupted, 5000);
    await scenario.settle(2000);
    expect(driver.link.interrupted).toBe(false);
    expect([driver.link.sessionsOpened, scenario.robot.counters.iceRestarts]).toEqual([1, 1]);
  });
});

describe('the lease', () => {
  test('of a silent page is free after its time, not before, and the next one drives', () => {
    using scenario = new Scenario({ args: ['--lease-silence-s', '3'] });
    const first = scenario.driving();
    const second = scenario.connected();
    cut(first, true);
    scenario.run(2900);
    expect(second.client.driver.holder).toBe('other');
    scenario.run(200);
    expect(second.client.driver.holder).toBe('nobody');
    second.hand.push(0.5);
    scenario.until(() => scenario.robot.wheels.speed === 0.5);
    // The first comes back with its grip held: it neither drives nor disturbs.
    const fromMs = scenario.nowMs;
    cut(first, false);
    scenario.run(5000);
    expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
    expect(first.client.driver.holder).toBe('other');
  });

  test('is not taken by who only presses the grip', () => {
    using scenario = new Scenario({ args: ['--take-policy', 'always'] });
    scenario.driving();
    const second = scenario.connected();
    const fromMs = scenario.nowMs;
    second.hand.push(-1);
    scenario.run(3000);
    expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
    expect(second.client.driver.lost).toBe('other-drives');
  });
});

describe('STOP', () => {
  test('pressed while the link is away stops the robot when it is back, and says so', () => {
    for (const seed of [1, ...SEEDS]) {
      using scenario = new Scenario({ seed, link: linkOf(seed) });
      const operator = scenario.connected();
      cut(operator, true);
      scenario.run(1500);
      operator.client.estop();
      scenario.run(20_000);
      expect([
        operator.client.stops.status,
        scenario.robot.core.host.drive.guard.estopState().latched,
      ]).toEqual(['unconfirmed', false]);
      cut(operator, false);
      scenario.until(() => operator.client.stops.status === 'confirmed', 5000);
      expect(scenario.robot.core.host.drive.guard.estopState().latched).toBe(true);
    }
  });

  test('of a watcher stops the driver’s robot within a way of the link', () => {
    for (const seed of SEEDS) {
      using scenario = new Scenario({ seed, link: linkOf(seed) });
      const driver = scenario.driving();
      const watcher = scenario.connected();
      watcher.client.estop();
      scenario.until(() => watcher.client.stops.status === 'confirmed', 2000);
      scenario.run(1500);
      expect([scenario.robot.wheels.speed, driver.client.link.session.estop.latched]).toEqual([0, true]);
    }
  });

  test('is not released by who does not drive, and moves nothing until the hand has let go', () => {
    using scenario = new Scenario();
    const driver = scenario.driving();
    const watcher = scenario.connected();
    driver.client.estop();
    scenario.run(1000);
    watcher.client.releaseEstop();
    scenario.run(1000);
    expect(driver.client.link.session.estop.latched).toBe(true);
    driver.client.releaseEstop();
    scenario.until(() => !driver.client.link.session.estop.latched);
    const fromMs = scenario.nowMs;
    scenario.run(3000);
    expect(scenario.robot.wheels.fastestSince(fromMs)).toBe(0);
    driver.hand.letGo();
    scenario.run(600);
    driver.hand.push(0.5);
    scenario.until(() => scenario.robot.wheels.speed === 0.5);
  });
});

describe('a gap in the commands', () => {
  test.each([
    [9, 0.5],
    [14, 0.5],
    [16, 0],
  ])('%i of which are missing: the robot brakes, and then drives at %f m/s', (missing, speed) => {
    using scenario = new Scenario();
    const driver = scenario.driving();
    const fromMs = scenario.nowMs;
    let left = missing;
    driver.hand.sends((command) => (left-- > 0 ? null : command));
    scenario.run(4000);
    expect(scenario.robot.wheels.braked(fromMs)).not.toBe(null);
    expect(scenario.robot.wheels.speed).toBe(speed);
  });
});
