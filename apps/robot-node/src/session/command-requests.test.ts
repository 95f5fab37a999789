import type { CommandAnswer, RobotSessionMessage } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { openAccess } from '../access/access.ts';
import type { CommandOptions } from '../robot-commands/command-configuration.ts';
import { CommandStation } from '../robot-commands/command-station.ts';
import { SimActor } from '../robot-commands/sim-actor.ts';
import { CommandRequests } from './command-requests.ts';

const lights: CommandOptions = {
  ...{
    id: 'lights',
    label: 'Lights',
    group: 'Signals',
    confirm: true,
    holdsLease: true,
    whileStopped: false,
  },
  ...{ perSecond: 1, timeoutMs: 1000, action: { kind: 'sim', action: 'lights' } },
};
const horn: CommandOptions = {
  ...{ ...lights, id: 'horn', label: 'Horn', group: undefined, confirm: false },
  ...{ holdsLease: false, whileStopped: true, action: { kind: 'sim', action: 'horn' } },
};

/** An operator of a robot with two commands; what it is told, and what the robot writes down. */
function operator() {
  const told: RobotSessionMessage[] = [];
  const answered: [string, CommandAnswer][] = [];
  const robot = { leaseHolder: 'somebody', latched: false, lateMs: 0, over: false };
  const access = { ...openAccess('Ada'), role: 'drive' as 'drive' | 'watch' };
  const guard = {
    get leaseHolder() {
      return robot.leaseHolder;
    },
    estopState: () => ({ type: 'estop', latched: robot.latched }),
    lateMs: () => robot.lateMs,
  };
  const actor = new SimActor();
  const requests = new CommandRequests(
    { id: 'ada', access, heardMs: 0, send: (message) => told.push(message) },
    {
      commands: new CommandStation(
        [lights, horn],
        () => actor,
        () => 0,
      ),
      drive: { guard: guard as never },
      rates: { over: () => robot.over },
      answered: (id, answer) => answered.push([id, answer]),
    },
  );
  let request = 0;
  const call = (id: string) => requests.take({ type: 'callCommand', id, request: ++request, timeMs: 0 });
  return { told, answered, robot, access, requests, call };
}

it('tells an operator the commands once, and then only what has changed for it', () => {
  const { told, robot, requests, access } = operator();
  requests.update();
  expect(told).toEqual([]);
  requests.tell();
  const shown = { type: 'robotCommand', id: 'lights', label: 'Lights', group: 'Signals', confirm: true };
  expect(told.splice(0)).toEqual([
    { ...shown, barred: 'not-driver' },
    { type: 'robotCommand', id: 'horn', label: 'Horn' },
  ]);
  requests.update();
  robot.leaseHolder = 'ada';
  requests.update();
  expect(told.splice(0)).toEqual([shown]);
  robot.latched = true;
  requests.update();
  expect(told.splice(0)).toEqual([{ ...shown, barred: 'estop' }]);
  access.role = 'watch';
  requests.update();
  expect(told.map((each) => 'barred' in each && each.barred)).toEqual(['not-permitted', 'not-permitted']);
});

it('does what the operator may, refuses the rest by reason, and writes both down', () => {
  const { told, answered, robot, call, access } = operator();
  const outcome = () => {
    const { outcome: what, reason } = told.at(-1) as CommandAnswer;
    return reason ?? what;
  };
  call('lights');
  expect(outcome()).toBe('not-driver');
  call('dock');
  expect(outcome()).toBe('unknown');
  call('horn');
  expect(told.at(-1)).toEqual({
    ...{ type: 'commandAnswer', request: 3, outcome: 'done', detail: 'the horn has sounded' },
  });
  call('horn');
  expect(outcome()).toBe('too-often');
  robot.leaseHolder = 'ada';
  robot.lateMs = 2001;
  call('lights');
  expect(outcome()).toBe('stale');
  robot.lateMs = 2000;
  robot.latched = true;
  call('lights');
  expect(outcome()).toBe('estop');
  robot.latched = false;
  call('lights');
  expect(outcome()).toBe('done');
  robot.over = true;
  call('lights');
  expect(outcome()).toBe('too-often');
  robot.over = false;
  access.role = 'watch';
  call('horn');
  expect(outcome()).toBe('not-permitted');
  expect(answered).toEqual([
    ...['lights', 'dock', 'horn', 'horn', 'lights', 'lights', 'lights', 'lights', 'horn'].map((id, index) => [
      id,
      told[index],
    ]),
  ]);
});
