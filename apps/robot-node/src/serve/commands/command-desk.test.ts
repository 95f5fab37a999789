import {
  decodeJson,
  encodeJson,
  type RobotSessionMessage,
  type Role,
  robotSessionCodec,
} from '@farpoint/protocol';
import { makeGuard } from '@farpoint/safety/testing';
import { describe, expect, it, vi } from 'vitest';
import { type ListedOperator, OperatorRoster } from '../../admit/access/operator-roster.ts';
import { RobotCounters } from '../../ground/robot-counters.ts';
import type { ActionPort, CommandActor } from './command-actor.ts';
import { barOf } from './command-bar.ts';
import type { CommandOptions } from './command-configuration.ts';
import { CommandDesk } from './command-desk.ts';

const usual: CommandOptions = {
  ...{ id: 'lights', label: 'Lights', confirm: false, who: 'driver', standing: false, onStop: 'continue' },
  ...{ perSecond: 10, timeoutMs: 5000, action: { kind: 'sim', action: 'lights' } },
};
const commands: CommandOptions[] = [
  usual,
  {
    ...usual,
    id: 'self-test',
    label: 'Self-test',
    group: 'Service',
    confirm: true,
    standing: true,
    onStop: 'cancel',
    action: { kind: 'sim', action: 'self-test' },
  },
  { ...usual, id: 'horn', who: 'watch' },
  { ...usual, id: 'bookmark', who: 'drive', action: { kind: 'record', action: 'bookmark' } },
  { ...usual, id: 'record', who: 'supervise', action: { kind: 'record', action: 'start' } },
];

/** Ada drives, Bob may, Wim watches, Sue supervises; what does the commands ends when it is told to. */
function robot() {
  const state = { nowMs: 0, stands: true, writes: false };
  const guard = makeGuard();
  const operators = new Map<string, ListedOperator>();
  const roster = new OperatorRoster();
  const counters = new RobotCounters();
  const audit = { command: vi.fn(), refused: vi.fn() };
  const asked: { text: string; port: ActionPort }[] = [];
  const cancel = vi.fn();
  const actor: CommandActor = {
    begin: ({ action, text }, port) => {
      asked.push({ text, port });
      return action.kind === 'sim' && action.action === 'self-test' ? cancel : null;
    },
    close: async () => undefined,
  };
  const recording = {
    get writes() {
      return state.writes;
    },
    progress: { bytes: 500, forS: 2.7 },
  };
  const desk = new CommandDesk({
    ...{ operators, roster, drive: { guard }, stands: () => state.stands, now: () => state.nowMs },
    commands: { commands, actorOf: () => actor, recording: recording as never },
    ...{ counters, audit, log: { info: vi.fn() } },
  });
  const join = (id: string, role: Role) => {
    const inbox: RobotSessionMessage[] = [];
    const grant = { id, subject: id, keyId: 'k', issuedAtS: 0 };
    const access = { role, subject: id, name: id, expiresAtS: 1, keyId: 'k', grant };
    const send = (message: RobotSessionMessage) =>
      void inbox.push(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, message)));
    const made: ListedOperator = { messages: { id, access, heardMs: 0, send }, peer: { connected: true } };
    operators.set(id, made);
    roster.numberOf(made);
    desk.welcome(made);
    let request = 0;
    const give = (command: string, more: { text?: string; request?: number; timeMs?: number } = {}) =>
      desk.request(made, {
        type: 'callCommand',
        id: command,
        request: ++request,
        timeMs: state.nowMs,
        ...more,
      });
    const stop = (run: number) => desk.request(made, { type: 'cancelCommand', run });
    return { made, give, stop, taken: () => inbox.splice(0) };
  };
  guard.requestLease('ada', false, 0);
  const pass = (ms: number) => {
    state.nowMs += ms;
    for (const { messages } of operators.values()) Object.assign(messages, { heardMs: state.nowMs });
    desk.update();
  };
  const [ada, bob, wim, sue] = [
    join('ada', 'drive'),
    join('bob', 'drive'),
    join('wim', 'watch'),
    join('sue', 'supervise'),
  ];
  const all = [ada, bob, wim, sue];
  return { state, guard, desk, counters, audit, asked, cancel, pass, join, ada, bob, wim, sue, all };
}

const refused = (request: number, reason: string) => [{ type: 'commandRefused', request, reason }];

describe('the robot’s commands and its operators', () => {
  it('are told after the welcome, and again when who may give them changes', () => {
    const { ada, bob, wim, sue, guard, state, pass } = robot();
    const bars = (messages: RobotSessionMessage[]) =>
      Object.fromEntries(
        messages.flatMap((each) => (each.type === 'robotCommand' ? [[each.id, each.barred]] : [])),
      );
    const first = ada.taken();
    expect(first[1]).toEqual({
      ...{
        type: 'robotCommand',
        id: 'self-test',
        label: 'Self-test',
        group: 'Service',
        confirm: true,
        cancel: true,
      },
    });
    expect(first[3]).toMatchObject({ id: 'bookmark', recording: 'bookmark' });
    expect(bars(first)).toMatchObject({ lights: undefined, record: 'not-permitted' });
    expect(bars(bob.taken())).toMatchObject({ lights: 'not-driver', horn: undefined, bookmark: undefined });
    expect(bars(wim.taken())).toMatchObject({
      lights: 'not-permitted',
      horn: undefined,
      bookmark: 'not-permitted',
    });
    expect(bars(sue.taken()).record).toBeUndefined();
    state.stands = false;
    pass(25);
    expect(bars(ada.taken())).toEqual({ 'self-test': 'moving' });
    state.stands = true;
    guard.latchEstop('operator', 'wim');
    pass(25);
    expect(bars(ada.taken())).toEqual({ 'self-test': 'estop' });
    pass(25);
    expect(ada.taken()).toEqual([]);
  });

  it('are told to everybody when they are begun and when they end, and written down', () => {
    const { ada, bob, asked, audit, counters, join, pass, all } = robot();
    for (const each of all) each.taken();
    ada.give('lights');
    const run = { type: 'commandRun', run: 1, id: 'lights', by: { number: 1, name: 'ada' } };
    expect(ada.taken()).toEqual([{ ...run, request: 1, state: 'running' }]);
    expect(bob.taken()).toEqual([{ ...run, state: 'running' }]);
    expect(join('eva', 'watch').taken().at(-1)).toEqual({ ...run, state: 'running' });
    asked[0]?.port.progress(0.5, 'half');
    pass(200);
    expect(bob.taken()).toEqual([{ ...run, state: 'running', progress: 0.5, detail: 'half' }]);
    asked[0]?.port.end({ state: 'done', detail: 'on' });
    expect(bob.taken()).toEqual([{ ...run, state: 'done', detail: 'on' }]);
    expect(audit.command.mock.calls.map(([, ...rest]) => rest)).toEqual([
      [1, 'lights', 'running', ''],
      [1, 'lights', 'done', 'on'],
    ]);
    expect([...counters.commandOutcomes.entries()]).toEqual([['done', 1]]);
  });

  it('are refused with the reason, and nothing is done', () => {
    const { ada, bob, wim, asked, audit, state, guard, all, pass } = robot();
    for (const each of all) each.taken();
    bob.give('lights');
    expect(bob.taken()).toEqual(refused(1, 'not-driver'));
    wim.give('bookmark');
    expect(wim.taken()).toEqual(refused(1, 'not-permitted'));
    ada.give('cmd-vel');
    ada.give('lights', { text: 'to everybody' });
    ada.give('bookmark', { request: 2 });
    expect(ada.taken()).toEqual([
      ...refused(1, 'unknown'),
      ...refused(2, 'no-text'),
      ...refused(2, 'repeated'),
    ]);
    state.stands = false;
    ada.give('self-test');
    expect(ada.taken()).toEqual(refused(4, 'moving'));
    guard.latchEstop('operator', 'wim');
    ada.give('self-test');
    expect(ada.taken()).toEqual(refused(5, 'estop'));
    // As its page does, so that the robot knows its clock.
    guard.onClockProbe('ada', 0, 0);
    pass(5000);
    ada.taken();
    ada.give('lights', { timeMs: 2999 });
    expect(ada.taken()).toEqual(refused(6, 'stale'));
    expect(asked).toEqual([]);
    expect(audit.refused.mock.calls.map(([what, why]) => `${what} ${why}`)).toContain('robot-command stale');
  });

  it('are taken from each operator only so often, and its flood costs others nothing', () => {
    const { wim, bob, asked, counters, all, pass } = robot();
    for (const each of all) each.taken();
    for (let k = 0; k < 100; k++) wim.give('lights');
    const answers = wim.taken();
    expect(
      answers.filter((each) => each.type === 'commandRefused' && each.reason === 'not-permitted'),
    ).toHaveLength(10);
    expect(counters.commandOutcomes.get('too-often')).toBe(90);
    bob.give('bookmark', { text: 'here' });
    expect(asked.map(({ text }) => text)).toEqual(['here']);
    pass(200);
    wim.taken();
    wim.give('lights');
    expect(wim.taken()).toMatchObject([{ reason: 'not-permitted' }]);
  });

  it('are cancelled by whoever may give them, by who gave them, and by STOP', () => {
    const { ada, bob, guard, cancel, asked, pass, all } = robot();
    for (const each of all) each.taken();
    ada.give('self-test');
    bob.taken();
    bob.stop(1);
    expect(bob.taken()).toEqual(refused(1, 'not-driver'));
    ada.stop(9);
    expect(ada.taken().at(-1)).toMatchObject({ request: 9, reason: 'unknown' });
    guard.handOver('ada', 'bob', 0);
    ada.stop(1);
    expect(cancel).toHaveBeenCalledOnce();
    asked[0]?.port.end({ state: 'cancelled', detail: '' });
    expect(bob.taken().at(-1)).toMatchObject({ state: 'cancelled', detail: 'by ada' });
    bob.give('self-test');
    // Latched and released again before anybody has looked.
    guard.latchEstop('operator', 'wim');
    guard.releaseEstop('sue', true);
    pass(25);
    expect(cancel).toHaveBeenCalledTimes(2);
    ada.give('lights');
    expect(ada.taken().at(-1)).toMatchObject({ reason: 'not-driver' });
  });

  it('say how much is recorded, once a second and once when it ends', () => {
    const { state, pass, wim, join, all } = robot();
    pass(25);
    for (const each of all) each.taken();
    state.writes = true;
    for (let k = 0; k < 81; k++) pass(25);
    const on = { type: 'recording', on: true, bytes: 500, forS: 2 };
    expect(wim.taken()).toEqual([on, on, on]);
    expect(join('eva', 'watch').taken().at(-1)).toEqual(on);
    state.writes = false;
    pass(25);
    pass(2000);
    expect(wim.taken()).toEqual([{ ...on, on: false }]);
  });

  it('are nobody’s who has shown no grant', () => {
    const { desk, asked, join } = robot();
    const { made, taken } = join('eve', 'watch');
    taken();
    Object.assign(made.messages.access, { grant: null });
    desk.request(made, { type: 'callCommand', id: 'horn', request: 1, timeMs: 0 });
    expect([taken(), asked]).toEqual([[], []]);
  });
});

it.each([
  ['watch', 'watch', false, null],
  ['drive', 'watch', false, 'not-permitted'],
  ['drive', 'drive', false, null],
  ['drive', null, false, null],
  ['driver', 'watch', true, 'not-permitted'],
  ['driver', 'drive', false, 'not-driver'],
  ['driver', 'supervise', false, 'not-driver'],
  ['driver', 'drive', true, null],
  ['supervise', 'drive', true, 'not-permitted'],
  ['supervise', null, true, 'not-permitted'],
  ['supervise', 'supervise', false, null],
] as const)('a command for %s is barred for a role %s that drives (%s): %s', (who, role, drives, bar) => {
  const access = { role } as never;
  const still = { drives, estop: false, moves: false };
  expect(barOf({ ...usual, who }, access, still)).toBe(bar);
  const stopped = { ...still, estop: true, moves: true };
  expect(barOf({ ...usual, who, onStop: 'cancel' }, access, stopped)).toBe(bar ?? 'estop');
  expect(barOf({ ...usual, who, standing: true }, access, stopped)).toBe(bar ?? 'moving');
});
