/** Robot commands between operators with the real client and a robot in virtual time. */
import type { CommandEnd } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { linkOf } from './faults/run-fault.ts';
import { SEEDS } from './faults/scenario-rig.ts';
import type { ScenarioOperator } from './operator.ts';
import { Scenario } from './scenario.ts';

const WITH_COMMANDS = { args: ['--sim-commands'] };

/** What the operator is told of its own and others' commands, from now on. */
function endsOf({ client }: ScenarioOperator): string[] {
  const ends: string[] = [];
  client.on('commandEnd', ({ id, by, outcome, reason, detail }: CommandEnd) =>
    ends.push([id, by ?? 'own', outcome, reason ?? detail ?? ''].join(' ').trim()),
  );
  return ends;
}

/** An operator who drives ahead, after its hand was seen open: a link that loses packets may lose the first that say so. */
function drivingIn(scenario: Scenario): ScenarioOperator {
  const driver = scenario.connected();
  scenario.run(1500);
  driver.hand.push(0.5);
  scenario.until(() => scenario.robot.wheels.speed > 0.1);
  return driver;
}

const barOf = ({ client }: ScenarioOperator, id: string) =>
  client.commands.list.find((each) => each.id === id)?.barred;

/** Sends what its own page would not. */
function force({ nowMs: timeMs }: Scenario, { client }: ScenarioOperator, id: string, request: number): void {
  client.link.sendSession({ type: 'callCommand', id, request, timeMs });
}

/** What the robot has said to calls that its page would not have sent. */
function refusalsOf(operator: ScenarioOperator): string[] {
  const refusals: string[] = [];
  const { commands } = operator.client;
  const take = commands.onRefused.bind(commands);
  commands.onRefused = (refused) => {
    refusals.push(refused.reason);
    take(refused);
  };
  return refusals;
}

test('a command that needs a robot at rest is barred while it moves, and refused to whoever sends it', () => {
  for (const seed of [1, ...SEEDS]) {
    using scenario = new Scenario({ ...WITH_COMMANDS, seed, link: linkOf(seed) });
    const driver = drivingIn(scenario);
    const refusals = refusalsOf(driver);
    scenario.until(() => barOf(driver, 'self-test') === 'moving');
    expect(driver.client.commands.give('self-test', scenario.nowMs)).toBe(false);
    force(scenario, driver, 'self-test', 1);
    scenario.until(() => refusals.length > 0);
    expect(refusals).toEqual(['moving']);
    driver.hand.letGo();
    scenario.until(() => barOf(driver, 'self-test') === undefined);
    expect(scenario.robot.wheels.speed).toBe(0);
  }
});

test('STOP cancels what runs, whoever presses it, and bars it until it is released', () => {
  for (const seed of [1, ...SEEDS]) {
    using scenario = new Scenario({ ...WITH_COMMANDS, seed, link: linkOf(seed) });
    const driver = drivingIn(scenario);
    const other = scenario.connected();
    const [own, others] = [endsOf(driver), endsOf(other)];
    driver.hand.letGo();
    scenario.until(() => barOf(driver, 'self-test') === undefined && driver.client.commands.list.length > 0);
    expect(driver.client.commands.give('self-test', scenario.nowMs)).toBe(true);
    scenario.until(() => other.client.commands.running('self-test') !== null);
    expect(other.client.commands.running('self-test')?.by).toBe('operator-1');
    other.client.estop();
    scenario.until(() => own.length > 0 && others.length > 0);
    expect([own, others]).toEqual([
      ['self-test own cancelled by STOP'],
      ['self-test operator-1 cancelled by STOP'],
    ]);
    scenario.until(() => barOf(driver, 'self-test') === 'estop');
    // What STOP does not concern is taken.
    expect(driver.client.commands.give('lights', scenario.nowMs)).toBe(true);
    scenario.until(() => own.length === 2);
    expect(own[1]).toBe('lights own done the lights are on');
  }
});

test('who does not drive gives the driver’s commands neither by its page nor otherwise, and those of all as often as one may', () => {
  using scenario = new Scenario(WITH_COMMANDS);
  drivingIn(scenario);
  const other = scenario.connected();
  const [ends, refusals] = [endsOf(other), refusalsOf(other)];
  scenario.until(() => barOf(other, 'lights') === 'not-driver');
  force(scenario, other, 'lights', 1);
  force(scenario, other, 'cmd-vel', 2);
  force(scenario, other, 'horn', 3);
  force(scenario, other, 'horn', 3);
  force(scenario, other, 'horn', 4);
  scenario.until(() => refusals.length === 4);
  expect(refusals).toEqual(['not-driver', 'unknown', 'repeated', 'too-often']);
  expect(ends).toEqual(['horn own done the horn has sounded']);
});

test('a command runs on without the one who gave it, and another driver cancels it', () => {
  using scenario = new Scenario(WITH_COMMANDS);
  const giver = drivingIn(scenario);
  const other = scenario.connected();
  const ends = endsOf(other);
  giver.hand.letGo();
  scenario.until(() => barOf(giver, 'self-test') === undefined);
  giver.client.commands.give('self-test', scenario.nowMs);
  scenario.until(() => other.client.commands.running('self-test') !== null);
  giver.client.leave();
  other.client.takeOver();
  scenario.until(() => barOf(other, 'lights') === undefined);
  expect(other.client.commands.cancel('self-test')).toBe(true);
  scenario.until(() => ends.length > 0);
  expect(ends).toEqual(['self-test operator-1 cancelled by operator-2']);
});
