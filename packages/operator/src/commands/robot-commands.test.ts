import type { CommandCall, CommandCancel, CommandRun, RobotCommand } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { type CommandEnd, RobotCommands } from './robot-commands.ts';

const lights: RobotCommand = { type: 'robotCommand', id: 'lights', label: 'Lights' };
const dock: RobotCommand = { type: 'robotCommand', id: 'dock', label: 'Dock', cancel: true };
const away: RobotCommand = { type: 'robotCommand', id: 'away', label: 'Away', barred: 'not-driver' };
const run = (change: Partial<CommandRun>): CommandRun => ({
  ...{ type: 'commandRun', run: 3, id: 'dock', by: { number: 4, name: 'Ada' }, state: 'running' },
  ...change,
});

function bench() {
  const sent: (CommandCall | CommandCancel)[] = [];
  const ends: CommandEnd[] = [];
  const link = { live: true, changes: 0 };
  const commands = new RobotCommands({
    send: (request) => {
      if (link.live) sent.push(request);
      return link.live;
    },
    onChange: () => link.changes++,
    onEnd: (end) => ends.push(end),
  });
  for (const each of [lights, dock, away]) commands.onCommand(each);
  return { sent, ends, link, commands };
}

test('lists what the robot tells, in its order, with what has changed', () => {
  const { commands } = bench();
  commands.onCommand({ ...lights, barred: 'estop' });
  expect(commands.list).toEqual([{ ...lights, barred: 'estop' }, dock, away]);
});

test('sends only the id of a command that may be given, once until it has ended', () => {
  const { commands, sent, ends } = bench();
  expect(commands.give('away', 5)).toBe(false);
  expect(commands.give('other', 5)).toBe(false);
  expect(commands.give('lights', 7)).toBe(true);
  expect(commands.give('lights', 8)).toBe(false);
  expect(sent).toEqual([{ type: 'callCommand', id: 'lights', request: 1, timeMs: 7 }]);
  commands.onRefused({ type: 'commandRefused', request: 9, reason: 'busy' });
  expect(commands.running('lights')).toEqual({ run: null, by: null, progress: null, detail: null });
  commands.onRefused({ type: 'commandRefused', request: 1, reason: 'too-often' });
  expect(ends).toEqual([
    { id: 'lights', label: 'Lights', by: null, outcome: 'refused', reason: 'too-often', detail: null },
  ]);
  expect(commands.give('lights', 9, 'here')).toBe(true);
  expect(sent[1]).toMatchObject({ request: 2, text: 'here' });
});

test('shows what runs, whoever gave it, and cancels only what can be', () => {
  const { commands, sent, ends } = bench();
  commands.give('dock', 1);
  expect(commands.cancel('dock')).toBe(false);
  commands.onRun(run({ request: 1, progress: 0.5, detail: 'turning' }));
  expect(commands.running('dock')).toEqual({ run: 3, by: null, progress: 0.5, detail: 'turning' });
  expect(commands.give('dock', 2)).toBe(false);
  expect(commands.cancel('dock')).toBe(true);
  expect(sent[1]).toEqual({ type: 'cancelCommand', run: 3 });
  commands.onRun(run({ request: 1, state: 'cancelled' }));
  expect(commands.running('dock')).toBeNull();
  commands.onRun(run({ run: 4, id: 'lights' }));
  expect(commands.running('lights')?.by).toBe('Ada');
  expect(commands.cancel('lights')).toBe(false);
  commands.onRun(run({ run: 4, id: 'lights', state: 'failed', detail: 'no lamp' }));
  expect(ends.map(({ id, by, outcome, detail }) => [id, by, outcome, detail])).toEqual([
    ['dock', null, 'cancelled', null],
    ['lights', 'Ada', 'failed', 'no lamp'],
  ]);
});

test('says so when nobody knows what became of it', () => {
  const { commands, ends, link } = bench();
  commands.give('lights', 0);
  commands.tick(9_999);
  expect(ends).toEqual([]);
  commands.tick(10_000);
  commands.give('lights', 20_000);
  commands.give('dock', 20_000);
  commands.onRun(run({ request: 3 }));
  commands.onRun(run({ run: 5, id: 'away' }));
  commands.onRecording({ type: 'recording', on: true, bytes: 5, forS: 1 });
  expect(commands.recording?.bytes).toBe(5);
  link.live = false;
  commands.reset();
  expect(ends.map(({ id, outcome }) => [id, outcome])).toEqual([
    ['lights', 'no-answer'],
    ['lights', 'link-lost'],
    ['dock', 'link-lost'],
  ]);
  expect([commands.list, commands.recording, commands.running('away')]).toEqual([[], null, null]);
  commands.onCommand(lights);
  expect(commands.give('lights', 80_000)).toBe(false);
});

test('a robot that tells more than it may have fills no memory', () => {
  const { commands, ends } = bench();
  for (let k = 0; k < 100; k++) commands.onCommand({ ...lights, id: `c${k}` });
  expect(commands.list).toHaveLength(32);
  commands.onRun(run({ id: 'c99' }));
  commands.onRun(run({ id: 'c99', state: 'done' }));
  expect([commands.running('c99'), ends]).toEqual([null, []]);
  commands.onCommand({ ...lights, label: 'Lamps' });
  expect(commands.list[0]?.label).toBe('Lamps');
});

test('a recording that has ended is none', () => {
  const { commands } = bench();
  commands.onRecording({ type: 'recording', on: true, bytes: 5, forS: 1 });
  commands.onRecording({ type: 'recording', on: false, bytes: 9, forS: 2 });
  expect(commands.recording).toBeNull();
});
