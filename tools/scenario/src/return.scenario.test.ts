/** A robot that has lost its operators comes back along its track, under guard. */
import type { ReturnState } from '@farpoint/protocol';
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { GuardSight } from './guard-sight.ts';
import type { ScenarioOperator } from './operator.ts';
import { Scenario } from './scenario.ts';
import { emptyOffice } from './worlds.ts';

const RETURNS = ['--return', '--return-after-s', '5', '--return-announce-s', '1', '--lease-silence-s', '1'];
/** How far the robot is driven, m: there is furniture farther ahead. */
const WAY_M = 0.7;
/** When it begins after the last that was heard, ms. */
const BEGINS_MS = 6000;

let sight: GuardSight;
let scenario: Scenario;

beforeEach(async () => {
  sight = await GuardSight.open(emptyOffice());
});
afterEach(() => {
  scenario[Symbol.dispose]();
  sight[Symbol.dispose]();
});

function start(...args: string[]): void {
  scenario = new Scenario({ args: [...RETURNS, ...args], world: emptyOffice(), sight });
}

const x = () => scenario.robot.base.state.pose.position.x;
const returns = () => scenario.robot.core.driving.returns;
const told = ({ client }: ScenarioOperator): ReturnState | undefined => client.telemetry?.motion?.return;

/** @returns where it began */
function drive({ hand }: ScenarioOperator, metres = WAY_M): number {
  const from = x();
  hand.push(0.4);
  scenario.until(() => Math.abs(x() - from) > metres);
  hand.letGo();
  scenario.until(() => scenario.robot.base.state.twist.linear.x === 0);
  return from;
}

describe('a robot that has lost its operators', () => {
  test('comes back to where it was first driven, not before its time, and says so to who comes then', () => {
    start('--return-unseen', 'slow');
    const driver = scenario.connected();
    const from = drive(driver);
    driver.vanish();
    const far = x();
    const heardMs = Math.max(...[...scenario.robot.sessions.values()].map((session) => session.heardMs));
    const nowMs = () => scenario.robot.core.host.now();
    scenario.until(() => returns()?.begun === 1, 20_000);
    expect(nowMs() - heardMs).toBeGreaterThanOrEqual(BEGINS_MS);
    // An update of the robot, and what was under way when the operator vanished.
    expect(nowMs() - heardMs).toBeLessThanOrEqual(BEGINS_MS + 50);
    expect(x()).toBe(far);
    scenario.until(() => returns()?.ends.get('track-end') === 1, 60_000);
    const next = scenario.connected();
    expect(told(next)).toMatchObject({ phase: 'ended', end: 'track-end' });
    expect(told(next)?.metres).toBeGreaterThan(WAY_M - 0.15);
    expect(Math.abs(x() - from)).toBeLessThan(0.15);
    // Whoever drives next is told of it no longer.
    drive(next, 0.1);
    expect(told(next)).toBe(undefined);
  });

  test.each(['gives the lease back', 'ends its session', 'closes its page'])(
    'stays where it is if its driver %s',
    (how) => {
      start('--return-unseen', 'slow');
      const driver = scenario.connected();
      drive(driver);
      if (how === 'gives the lease back') {
        driver.client.driver.releaseLease();
        scenario.run(100);
        driver.vanish();
      } else if (how === 'ends its session') driver.client.leave();
      // Its connection is closed before the robot hears from the service that this was meant.
      else driver.link.disconnect();
      const far = x();
      scenario.run(20_000);
      expect([returns()?.begun, x()]).toEqual([0, far]);
    },
  );

  test('stands as soon as its link is back, and waits for a fresh hand', () => {
    start('--return-unseen', 'slow');
    const driver = scenario.connected();
    const from = drive(driver);
    const far = x();
    const cut = (active: boolean) => {
      for (const direction of [driver.up, driver.down]) direction.blackhole(active);
    };
    cut(true);
    driver.hand.push(0.4);
    scenario.until(() => (returns()?.metres ?? 0) >= 0.2, 30_000);
    cut(false);
    scenario.until(() => returns()?.ends.get('service-back') === 1);
    scenario.until(() => scenario.robot.base.state.twist.linear.x === 0);
    const stood = x();
    expect(stood).toBeGreaterThan(from + 0.1);
    expect(stood).toBeLessThan(far - 0.19);
    // The hand holds on.
    scenario.run(3000);
    expect(x()).toBe(stood);
    driver.hand.letGo();
    scenario.run(1000);
    expect(drive(driver, 0.1)).toBe(stood);
  });

  test('stands when STOP that was pressed meanwhile arrives, and does not go on when that is released', () => {
    start('--return-unseen', 'slow');
    const driver = scenario.connected();
    drive(driver);
    for (const direction of [driver.up, driver.down]) direction.blackhole(true);
    scenario.until(() => (returns()?.metres ?? 0) >= 0.1, 30_000);
    driver.client.estop();
    scenario.run(200);
    for (const direction of [driver.up, driver.down]) direction.blackhole(false);
    scenario.until(() => driver.client.stops.status === 'confirmed');
    scenario.until(() => scenario.robot.base.state.twist.linear.x === 0, 1000);
    const stood = x();
    driver.client.releaseEstop();
    scenario.until(() => !driver.client.link.session.estop.latched);
    scenario.run(5000);
    expect(x()).toBe(stood);
  });

  test('stands when it is stopped at the robot, and for good', () => {
    start('--return-unseen', 'slow');
    const driver = scenario.connected();
    drive(driver);
    driver.vanish();
    scenario.until(() => (returns()?.metres ?? 0) >= 0.2, 30_000);
    const { guard } = scenario.robot.core.host.drive;
    guard.holdEstop('gpio');
    scenario.robot.core.host.drive.apply();
    scenario.until(() => scenario.robot.base.state.twist.linear.x === 0, 1000);
    guard.letGoEstop('gpio');
    const stood = x();
    scenario.run(20_000);
    expect([returns()?.ends.get('estop'), x()]).toEqual([1, stood]);
  });

  test('stays where no sensor sees the way back, unless it is told otherwise', () => {
    start();
    const driver = scenario.connected();
    drive(driver);
    const far = x();
    driver.vanish();
    scenario.until(() => returns()?.ends.get('unseen') === 1, 60_000);
    expect([x(), returns()?.metres]).toEqual([far, 0]);
  });

  test('stands while its camera gives nothing', () => {
    start('--return-unseen', 'slow');
    const driver = scenario.connected();
    drive(driver);
    const far = x();
    driver.vanish();
    sight.sees = false;
    scenario.run(20_000);
    expect(x()).toBe(far);
  });
});
