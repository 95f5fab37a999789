import { type CommandEnd, RobotCommands, type RobotEvents } from '@farpoint/operator';
import type { CommandCall, CommandCancel, CommandRun, RobotCommand } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { CommandsState } from './commands-state.ts';
import { Sampler } from './sampler.ts';

const lights: RobotCommand = { type: 'robotCommand', id: 'lights', label: 'Lights', group: 'Signals' };
const dock: RobotCommand = { type: 'robotCommand', id: 'dock', label: 'Dock', confirm: true, cancel: true };
const records = (['start', 'stop', 'bookmark'] as const).map(
  (recording): RobotCommand => ({
    type: 'robotCommand',
    id: recording,
    label: `Rec ${recording}`,
    recording,
  }),
);
const runOf = (change: Partial<CommandRun>): CommandRun => ({
  ...{ type: 'commandRun', run: 3, id: 'dock', by: { number: 4, name: 'Ada' }, state: 'running' },
  ...change,
});

function page() {
  const sent: (CommandCall | CommandCancel)[] = [];
  const told: string[] = [];
  const link = { live: true, nowMs: 0 };
  const samples = new Sampler();
  const listeners = new Map<string, (event: never) => void>();
  const emit = <T extends keyof RobotEvents>(type: T, event: RobotEvents[T]) => {
    listeners.get(type)?.(event as never);
    samples.take(link.nowMs);
  };
  const commands = new RobotCommands({
    send: (request) => {
      if (link.live) sent.push(request);
      return link.live;
    },
    onChange: (changed) => emit('commands', changed),
    onEnd: (end: CommandEnd) => emit('commandEnd', end),
  });
  const state = new CommandsState({
    client: {
      commands,
      on: (type, listener) => {
        listeners.set(type, listener);
        return () => {};
      },
    },
    samples,
    tell: ({ text, tone }) => told.push(`${tone} ${text}`),
    now: () => link.nowMs,
  });
  for (const each of [lights, dock, ...records]) commands.onCommand(each);
  const shown = () => {
    samples.take(link.nowMs);
    return state.groups.value.flatMap((group) => group.commands);
  };
  const given = () => sent.flatMap((each) => (each.type === 'callCommand' ? [each.id] : []));
  return { state, commands, sent, given, told, link, shown };
}

describe('the robot’s commands on the page', () => {
  test('are shown by group, and given by a press, or by two where they are to be confirmed', () => {
    const { state, given, told, link, shown } = page();
    expect(state.groups.value.map(({ name, commands }) => [name, ...commands.map(({ id }) => id)])).toEqual([
      ['Signals', 'lights'],
      ['', 'dock'],
    ]);
    state.press('lights');
    state.press('dock');
    expect(given()).toEqual(['lights']);
    expect(shown()).toMatchObject([
      { state: 'running', note: 'running' },
      { state: 'armed', text: 'Press again: Dock' },
    ]);
    expect(told).toEqual(['neutral Dock: press again within 3 s.']);
    link.nowMs = 2000;
    state.press('dock');
    expect(given()).toEqual(['lights', 'dock']);
  });

  test('are not confirmed too late, by way of another, or after they were barred', () => {
    const { state, commands, given, link, shown } = page();
    state.press('dock');
    link.nowMs = 3000;
    expect(shown()[1]).toMatchObject({ state: 'free', text: 'Dock' });
    state.press('dock');
    link.nowMs += 1000;
    state.press('lights');
    state.press('dock');
    expect(given()).toEqual(['lights']);
    commands.onCommand({ ...dock, barred: 'moving' });
    commands.onCommand(dock);
    link.nowMs += 1000;
    state.press('dock');
    expect(given()).toEqual(['lights']);
  });

  test('say why they cannot be given, and give nothing then', () => {
    const { state, commands, given, told, link, shown } = page();
    commands.onCommand({ ...lights, barred: 'estop' });
    expect(shown()[0]).toMatchObject({ state: 'barred', note: 'not while the emergency stop is on' });
    state.press('lights');
    commands.onCommand(lights);
    link.live = false;
    state.press('lights');
    state.press('other');
    expect(given()).toEqual([]);
    expect(told).toEqual([
      'warning Lights: not while the emergency stop is on.',
      'warning Lights: there is no connection to the robot.',
    ]);
  });

  test('show how far they are and who gave them, and can be cancelled', () => {
    const { state, commands, sent, told, shown } = page();
    commands.onRun(runOf({ progress: 0.5, detail: 'turning' }));
    expect(shown()[1]).toEqual({
      ...{ id: 'dock', text: 'Dock', note: 'turning (running, given by Ada)', state: 'running' },
      ...{ progress: 0.5, cancel: 'Cancel: Dock' },
    });
    state.cancel('dock');
    expect(sent).toEqual([{ type: 'cancelCommand', run: 3 }]);
    commands.onRun(runOf({ state: 'cancelled' }));
    expect(told).toEqual([]);
    expect(shown()[1]).toMatchObject({ state: 'free', note: '', cancel: null });
  });

  test('tell their own operator what becomes of them', () => {
    const { state, commands, told } = page();
    state.press('lights');
    commands.onRun(runOf({ id: 'lights', request: 1, state: 'failed', detail: 'no lamp' }));
    state.press('lights');
    commands.onRefused({ type: 'commandRefused', request: 2, reason: 'too-often' });
    state.press('lights');
    commands.onRun(runOf({ id: 'lights', request: 3, state: 'done' }));
    expect(told).toEqual([
      'bad Lights: failed (no lamp).',
      'warning Lights: refused (given too often).',
      'good Lights: done.',
    ]);
  });
});

test('the recording has one button, and bookmarks while it is on', () => {
  const { state, commands, sent } = page();
  expect(state.recording.value).toMatchObject({ isOn: false, line: 'Not recording', bookmark: null });
  expect(state.recording.value?.button).toMatchObject({ id: 'start', text: 'Rec start' });
  commands.onRecording({ type: 'recording', on: true, bytes: 48_400_000, forS: 62 });
  expect(state.recording.value).toMatchObject({ isOn: true, line: 'Recording 1:02, 48 MB' });
  expect(state.recording.value?.button?.id).toBe('stop');
  state.press('bookmark', 'wheel slips');
  expect(sent.at(-1)).toMatchObject({ id: 'bookmark', text: 'wheel slips' });
  commands.reset();
  expect(state.recording.value).toBeNull();
  commands.onRecording({ type: 'recording', on: true, bytes: 0, forS: 0 });
  expect(state.recording.value).toMatchObject({ isOn: true, button: null, bookmark: null });
});
