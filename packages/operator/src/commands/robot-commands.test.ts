import type { CommandCall, RobotCommand } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { type CommandResult, RobotCommands } from './robot-commands.ts';

const lights: RobotCommand = { type: 'robotCommand', id: 'lights', label: 'Lights' };
const dock: RobotCommand = { type: 'robotCommand', id: 'dock', label: 'Dock', barred: 'not-driver' };

function bench() {
  const sent: CommandCall[] = [];
  const results: CommandResult[] = [];
  const link = { live: true, changes: 0 };
  const commands = new RobotCommands({
    send: (call) => {
      if (link.live) sent.push(call);
      return link.live;
    },
    onChange: () => link.changes++,
    onResult: (result) => results.push(result),
  });
  commands.onCommand(lights);
  commands.onCommand(dock);
  return { sent, results, link, commands };
}

test('lists what the robot tells, in its order, with what has changed', () => {
  const { commands } = bench();
  commands.onCommand({ ...lights, barred: 'estop' });
  expect(commands.list).toEqual([{ ...lights, barred: 'estop' }, dock]);
});

test('sends only the id of a command that may be given, once until it is answered', () => {
  const { commands, sent, results } = bench();
  expect(commands.give('dock', 5)).toBe(false);
  expect(commands.give('other', 5)).toBe(false);
  expect(commands.give('lights', 7)).toBe(true);
  expect(commands.give('lights', 8)).toBe(false);
  expect(sent).toEqual([{ type: 'callCommand', id: 'lights', request: 1, timeMs: 7 }]);
  expect(commands.isWaiting('lights')).toBe(true);
  commands.onAnswer({ type: 'commandAnswer', request: 9, outcome: 'done' });
  expect(results).toEqual([]);
  commands.onAnswer({ type: 'commandAnswer', request: 1, outcome: 'refused', reason: 'too-often' });
  commands.onAnswer({ type: 'commandAnswer', request: 1, outcome: 'done' });
  expect(results).toEqual([
    { id: 'lights', label: 'Lights', outcome: 'refused', reason: 'too-often', detail: null },
  ]);
  expect(commands.give('lights', 9)).toBe(true);
  expect(sent[1]?.request).toBe(2);
});

test('says so when nobody knows what became of it', () => {
  const { commands, results, link } = bench();
  commands.give('lights', 0);
  commands.tick(64_999);
  expect(results).toEqual([]);
  commands.tick(65_000);
  expect(results.map(({ outcome }) => outcome)).toEqual(['no-answer']);
  commands.give('lights', 70_000);
  link.live = false;
  commands.reset();
  expect(results.map(({ outcome }) => outcome)).toEqual(['no-answer', 'link-lost']);
  expect(commands.list).toEqual([]);
  commands.onCommand(lights);
  expect(commands.give('lights', 80_000)).toBe(false);
  expect(commands.isWaiting('lights')).toBe(false);
});
