import type { CommandResult, RobotCommand, RobotEvents } from '@farpoint/operator';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { resultWords } from './command-words.ts';
import { CommandsState } from './commands-state.ts';
import { CONFIRM_MS, PressTwice } from './press-twice.ts';

const lights: RobotCommand = { type: 'robotCommand', id: 'lights', label: 'Lights', group: 'Signals' };
const dock: RobotCommand = { type: 'robotCommand', id: 'dock', label: 'Dock', confirm: true };

function page() {
  const given: string[] = [];
  const told: string[] = [];
  const later: (() => void)[] = [];
  const waiting = new Set<string>();
  const link = { live: true, nowMs: 0 };
  const listeners = new Map<string, (event: never) => void>();
  const emit = <T extends keyof RobotEvents>(type: T, event: RobotEvents[T]) =>
    listeners.get(type)?.(event as never);
  const state = new CommandsState({
    client: {
      on: (type, listener) => {
        listeners.set(type, listener);
        return () => {};
      },
      commands: {
        isWaiting: (id: string) => waiting.has(id),
        give: (id: string) => {
          if (link.live) given.push(id);
          return link.live;
        },
      } as never,
    },
    tell: ({ text }) => told.push(text),
    now: () => link.nowMs,
    after: (_, act) => later.push(act),
  });
  const shown = () => state.shown.value.map(({ text }) => text);
  emit('commands', [lights, dock]);
  return { state, given, told, later, waiting, link, emit, shown };
}

describe('the robot’s commands on the page', () => {
  test('are given by a press, or by two where they are to be confirmed', () => {
    const { state, given, told, link, shown } = page();
    expect(shown()).toEqual(['Lights', 'Dock']);
    state.press('lights');
    state.press('dock');
    expect([given, shown()]).toEqual([['lights'], ['Lights', 'Press again: Dock']]);
    expect(told).toEqual(['Dock: press again within 3 s']);
    link.nowMs = 2000;
    state.press('dock');
    expect([given, shown()]).toEqual([
      ['lights', 'dock'],
      ['Lights', 'Dock'],
    ]);
  });

  test('are not confirmed too late, by a double click, by way of another, or after they were barred', () => {
    const { state, given, link, later, shown, emit } = page();
    state.press('dock');
    link.nowMs = 200;
    state.press('dock');
    expect(given).toEqual([]);
    link.nowMs = CONFIRM_MS;
    later.at(-1)?.();
    expect(shown()).toEqual(['Lights', 'Dock']);
    state.press('dock');
    state.press('lights');
    link.nowMs += 1000;
    state.press('dock');
    expect(given).toEqual(['lights']);
    emit('commands', [lights, { ...dock, barred: 'not-driver' }]);
    emit('commands', [lights, dock]);
    link.nowMs += 1000;
    state.press('dock');
    expect(given).toEqual(['lights']);
  });

  test('say why they cannot be given, and give nothing then', () => {
    const { state, given, told, link, waiting, emit, shown } = page();
    emit('commands', [{ ...lights, barred: 'estop' }, dock]);
    state.press('lights');
    expect(state.shown.value[0]).toMatchObject({ bar: 'estop', armed: false });
    waiting.add('dock');
    emit('commands', [lights, dock]);
    expect(shown()).toEqual(['Lights', 'Dock …']);
    state.press('dock');
    link.live = false;
    state.press('lights');
    state.press('other');
    expect(given).toEqual([]);
    expect(told).toEqual([
      'Lights: not while the emergency stop is on',
      'Lights: there is no link to the robot',
    ]);
    emit('commands', []);
    expect(shown()).toEqual([]);
  });

  test.each<[Partial<CommandResult>, string]>([
    [{ outcome: 'done' }, 'Dock: done'],
    [{ outcome: 'done', detail: 'the battery charges' }, 'Dock: the battery charges'],
    [{ outcome: 'refused', reason: 'not-driver' }, 'Dock was refused: only who drives may'],
    [{ outcome: 'failed', detail: 'no charger' }, 'Dock failed: no charger'],
    [{ outcome: 'timed-out' }, 'Dock: nothing has answered. It may be done or not.'],
    [{ outcome: 'link-lost' }, 'Dock: the link was lost. It may be done or not.'],
  ])('%j is told as “%s”', (result, text) => {
    const { emit, told } = page();
    const whole = { id: 'dock', label: 'Dock', outcome: 'done', reason: null, detail: null, ...result };
    emit('commandResult', whole as CommandResult);
    expect(told).toEqual([text]);
    expect(resultWords(whole as CommandResult).tone).toMatch(/good|warning|bad/);
  });
});

test('nothing is done without two presses of the same, between 0.3 and 3 s apart', () => {
  const presses = fc.array(fc.tuple(fc.constantFrom('a', 'b'), fc.integer({ min: 0, max: 4000 })));
  fc.assert(
    fc.property(presses, (all) => {
      const twice = new PressTwice();
      let nowMs = 0;
      let earlier: [string, number][] = [];
      for (const [id, gapMs] of all) {
        nowMs += gapMs;
        if (twice.press(id, nowMs)) {
          const first = earlier.find(
            ([other, atMs]) => other === id && nowMs - atMs >= 300 && nowMs - atMs < CONFIRM_MS,
          );
          expect(first).toBeDefined();
          earlier = [];
        } else earlier.push([id, nowMs]);
      }
    }),
    { seed: 1, numRuns: 300 },
  );
});
