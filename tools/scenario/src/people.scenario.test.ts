/** What becomes of the drive between two operators with the real client, on links that lose and delay. */
import type { Handover } from '@farpoint/operator';
import { describe, expect, test } from 'vitest';
import { linkOf } from './faults/run-fault.ts';
import { SEEDS } from './faults/scenario-rig.ts';
import type { ScenarioOperator } from './operator.ts';
import { Scenario } from './scenario.ts';

/** What the operator is told of requests and offers, from now on. */
function toldOf({ client }: ScenarioOperator): Handover[] {
  const told: Handover[] = [];
  client.on('handover', (handover) => told.push(handover));
  return told;
}

const numberOf = ({ client }: ScenarioOperator) =>
  client.link.session.operators?.operators.find(({ you }) => you)?.number ?? Number.NaN;

/** One drives ahead, and has offered the drive to the other. */
function offered(scenario: Scenario) {
  const giver = scenario.driving();
  const taker = scenario.connected();
  const told = toldOf(taker);
  scenario.until(() => !Number.isNaN(numberOf(taker)));
  expect(giver.client.people.offerDrive(numberOf(taker))).toBe(true);
  scenario.until(() => told.length > 0);
  const [offer] = told;
  return { giver, taker, told, id: offer?.id ?? -1 };
}

describe('an offer that is accepted', () => {
  test('stops the robot, whoever holds on, and lets the new hand drive once it was opened', () => {
    for (const seed of [1, ...SEEDS]) {
      using scenario = new Scenario({ seed, link: linkOf(seed) });
      const { giver, taker, told, id } = offered(scenario);
      const { wheels } = scenario.robot;
      expect(wheels.speed).toBe(0.5);
      taker.hand.push(-1);
      scenario.run(200);
      expect(wheels.speed).toBe(0.5);
      taker.client.people.answer(id, true);
      scenario.until(() => told.at(-1)?.ended === 'accepted');
      scenario.until(() => wheels.speed === 0, 2000);
      const standsMs = scenario.nowMs;
      scenario.run(5000);
      expect(wheels.fastestSince(standsMs), scenario.log.text).toBe(0);
      expect([taker.client.driver.holder, giver.client.driver.holder]).toEqual(['you', 'other']);
      expect(taker.client.driver.lost).toBe('other-drives');
      expect(taker.client.link.session.people.open(scenario.nowMs)).toEqual([]);
      taker.hand.letGo();
      scenario.run(1000);
      taker.hand.push(0.5);
      scenario.until(() => wheels.speed === 0.5);
    }
  });

  test('lets an open hand drive by its first grip', () => {
    for (const seed of [1, ...SEEDS]) {
      using scenario = new Scenario({ seed, link: linkOf(seed) });
      const { giver, taker, told, id } = offered(scenario);
      giver.hand.letGo();
      taker.client.people.answer(id, true);
      scenario.until(() => told.at(-1)?.ended === 'accepted');
      scenario.run(1500);
      taker.hand.push(0.5);
      scenario.until(() => scenario.robot.wheels.speed === 0.5, 3000);
    }
  });
});

test('an offer ends with STOP, also where it was released again, and the driver keeps the lease', () => {
  using scenario = new Scenario();
  const { giver, taker, told, id } = offered(scenario);
  taker.client.estop();
  scenario.until(() => told.at(-1)?.ended === 'estop');
  const { pressedBy, yours, release } = giver.client.link.session.estopCause ?? {};
  expect([pressedBy, yours, release]).toEqual(['operator-2', false, 'driver']);
  expect(taker.client.link.session.estopCause?.yours).toBe(true);
  giver.hand.letGo();
  giver.client.releaseEstop();
  scenario.until(() => !giver.client.link.session.estop.latched);
  expect(giver.client.link.session.estopCause).toBeNull();
  const faults: string[] = [];
  taker.client.on('robotFault', (fault) => faults.push(fault));
  taker.client.people.answer(id, true);
  scenario.until(() => faults.length > 0);
  expect(giver.client.driver.holder).toBe('you');
});

test('an offer of a driver whose link is cut ends with the lease, or with its time', () => {
  for (const seconds of ['2', '30']) {
    using scenario = new Scenario({ args: ['--lease-silence-s', seconds] });
    const { giver, taker, told, id } = offered(scenario);
    giver.up.blackhole(true);
    giver.down.blackhole(true);
    scenario.run(16_000);
    expect(told.at(-1)?.ended).toBe(seconds === '2' ? 'driver-changed' : 'expired');
    taker.client.people.answer(id, true);
    scenario.run(1000);
    expect(taker.client.driver.holder).not.toBe('you');
    expect(scenario.robot.wheels.speed).toBe(0);
  }
});

test('the driver gives the drive to who asks, refuses, and goes on driving meanwhile', () => {
  using scenario = new Scenario();
  const driver = scenario.driving();
  const other = scenario.connected();
  const [asked, told] = [toldOf(driver), toldOf(other)];
  const fromMs = scenario.nowMs;
  other.client.people.askToDrive();
  scenario.until(() => asked.length > 0);
  driver.client.people.answer(asked[0]?.id ?? -1, false);
  scenario.until(() => told.at(-1)?.ended === 'refused');
  other.client.people.askToDrive();
  scenario.run(10_000);
  expect([asked.length, scenario.robot.wheels.braked(fromMs)]).toEqual([2, null]);
  other.client.people.askToDrive();
  scenario.until(() => asked.length === 3);
  driver.client.people.answer(asked[2]?.id ?? -1, true);
  scenario.until(() => other.client.driver.holder === 'you');
});
