/** What a grant lets an operator do, and when it ends. Its signature is verified elsewhere, before a session begins. */
import { expect, test } from 'vitest';
import { Scenario } from './scenario.ts';

const WARNING_MS = 60_000;
/** An update of the robot, and the way to the operator. */
const SOON_MS = 31;

test('one that lets its holder watch moves nothing, takes no lease, and still stops the robot', () => {
  using scenario = new Scenario({ args: ['--take-policy', 'always'] });
  const driver = scenario.driving(0.5, scenario.access('drive', 'Ada'));
  const watcher = scenario.connected('watcher', scenario.access('watch', 'Bob'));
  const fromMs = scenario.nowMs;
  watcher.client.takeOver();
  watcher.hand.push(-1);
  scenario.run(2000);
  expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
  expect([driver.client.driver.holder, watcher.client.driver.holder]).toEqual(['you', 'other']);
  expect(watcher.client.link.session.lease.driver).toBe('Ada');
  watcher.client.estop();
  scenario.run(500);
  expect(scenario.robot.wheels.speed).toBe(0);
});

test('a driver is warned a minute before the end, and stands when it comes', () => {
  using scenario = new Scenario();
  const lastsMs = 75_000;
  const endsAtMs = scenario.nowMs + lastsMs;
  const driver = scenario.driving(0.5, scenario.access('drive', 'Ada', lastsMs));
  const warnedMs: number[] = [];
  driver.client.on('grantExpires', () => warnedMs.push(scenario.nowMs));
  scenario.until(() => warnedMs.length > 0, lastsMs);
  expect((warnedMs[0] ?? 0) - (endsAtMs - WARNING_MS)).toBeGreaterThanOrEqual(0);
  expect((warnedMs[0] ?? 0) - (endsAtMs - WARNING_MS)).toBeLessThanOrEqual(SOON_MS);
  const fromMs = scenario.nowMs;
  scenario.run(endsAtMs - fromMs - 1);
  expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
  scenario.run(1 + SOON_MS);
  const brakedMs = scenario.robot.wheels.braked(fromMs)?.atMs ?? 0;
  expect(brakedMs - endsAtMs).toBeGreaterThanOrEqual(0);
  expect(brakedMs - endsAtMs).toBeLessThanOrEqual(SOON_MS);
  scenario.run(1000);
  expect([scenario.robot.wheels.speed, driver.link.lastLoss]).toEqual([0, 'grant-expired']);
});

test('a supervisor takes the lease of a driver whose robot allows no taking', () => {
  using scenario = new Scenario({ args: ['--take-policy', 'never'] });
  const driver = scenario.driving(0.5, scenario.access('drive', 'Ada'));
  const other = scenario.connected('other', scenario.access('drive', 'Cyd'));
  const fromMs = scenario.nowMs;
  other.client.takeOver();
  scenario.run(500);
  expect(scenario.robot.wheels.braked(fromMs)).toBe(null);
  const supervisor = scenario.connected('supervisor', scenario.access('supervise', 'Bob'));
  supervisor.client.takeOver();
  scenario.run(500);
  expect([scenario.robot.wheels.speed, driver.client.driver.holder]).toEqual([0, 'other']);
  expect(supervisor.client.driver.holder).toBe('you');
});

test('a supervisor ends a driver’s session: the robot stands, and the page does not come back by itself', () => {
  using scenario = new Scenario();
  const driver = scenario.driving(0.5, scenario.access('drive', 'Ada'));
  const supervisor = scenario.connected('supervisor', scenario.access('supervise', 'Bob'));
  scenario.run(500);
  const number = supervisor.client.link.session.operators?.operators.find(
    ({ name }) => name === 'Ada',
  )?.number;
  supervisor.client.endSession(number ?? -1);
  scenario.run(500);
  expect(scenario.robot.wheels.speed).toBe(0);
  scenario.run(30_000);
  expect([driver.link.lastLoss, driver.client.phase]).toEqual(['ended-by-supervisor', 'none']);
  expect(scenario.robot.sessions.size).toBe(1);
});
