import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { ActionResult, CommandActor } from './command-actor.ts';
import { barOf } from './command-bar.ts';
import type { CommandAction, CommandOptions } from './command-configuration.ts';
import { type CommandEnd, CommandStation } from './command-station.ts';
import { SimActor } from './sim-actor.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const lights: CommandOptions = {
  ...{ id: 'lights', label: 'Lights', confirm: false, holdsLease: true, whileStopped: true },
  ...{ perSecond: 1, timeoutMs: 1000, action: { kind: 'sim', action: 'lights' } },
};

/** Answers when it is told to. */
class Actor implements CommandActor {
  readonly asked: ((result: ActionResult) => void)[] = [];
  act(_action: CommandAction, _timeoutMs: number, onResult: (result: ActionResult) => void): void {
    this.asked.push(onResult);
  }
  async close(): Promise<void> {}
}

function station(...commands: CommandOptions[]) {
  const actor = new Actor();
  const ends: CommandEnd[] = [];
  const one = new CommandStation(commands, () => actor, Date.now);
  return { actor, ends, station: one, give: (id: string) => one.give(id, 'Ann', (end) => ends.push(end)) };
}

describe('the robot’s commands', () => {
  it('are done, fail, and are counted', () => {
    const { actor, ends, station: one, give } = station(lights);
    expect(give('lights')).toBeNull();
    actor.asked[0]?.({ done: true, detail: 'on' });
    vi.advanceTimersByTime(1000);
    expect(give('lights')).toBeNull();
    actor.asked[1]?.({ done: false, detail: `no\u0000\n${'x'.repeat(500)}` });
    expect(ends).toEqual([
      { outcome: 'done', detail: 'on' },
      { outcome: 'failed', detail: `no ${'x'.repeat(197)}` },
    ]);
    expect([...one.begun.entries()]).toEqual([['lights', 2]]);
  });

  it('are nothing but those of the configuration', () => {
    const { actor, give } = station(lights);
    for (const id of ['light', 'lights ', '', '__proto__', 'constructor']) expect(give(id)).toBe('unknown');
    expect(actor.asked).toEqual([]);
  });

  it('are given one at a time, and not too often', () => {
    const { actor, give } = station(lights, { ...lights, id: 'horn' });
    expect(give('lights')).toBeNull();
    expect(give('lights')).toBe('busy');
    expect(give('horn')).toBeNull();
    actor.asked[0]?.({ done: true, detail: '' });
    expect(give('lights')).toBe('too-often');
    vi.advanceTimersByTime(999);
    expect(give('lights')).toBe('too-often');
    vi.advanceTimersByTime(1);
    expect(give('lights')).toBeNull();
  });

  it('end after their time, once, and an answer that comes later ends no other', () => {
    const { actor, ends, give } = station(lights);
    give('lights');
    vi.advanceTimersByTime(999);
    expect(ends).toEqual([]);
    vi.advanceTimersByTime(1);
    expect(ends).toEqual([{ outcome: 'timed-out', detail: '' }]);
    give('lights');
    actor.asked[0]?.({ done: true, detail: 'late' });
    expect(ends).toHaveLength(1);
    actor.asked[1]?.({ done: true, detail: 'in time' });
    actor.asked[1]?.({ done: false, detail: 'twice' });
    expect(ends.slice(1)).toEqual([{ outcome: 'done', detail: 'in time' }]);
  });

  it('never exceed their rate, whoever gives them and whenever', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 4 }),
        fc.array(fc.integer({ min: 0, max: 700 }), { maxLength: 60 }),
        (perSecond, gaps) => {
          const { actor, give } = station({ ...lights, perSecond });
          const startMs = Date.now();
          for (const gap of gaps) {
            vi.advanceTimersByTime(gap);
            if (give('lights') === null) actor.asked.at(-1)?.({ done: true, detail: '' });
          }
          const seconds = (Date.now() - startMs) / 1000;
          expect(actor.asked.length).toBeLessThanOrEqual(perSecond + seconds * perSecond);
        },
      ),
      { seed: 1, numRuns: 100 },
    );
  });
});

it('the simulated robot’s lights go on and off', () => {
  const actor = new SimActor();
  const said: string[] = [];
  for (const action of ['lights', 'lights', 'horn'] as const)
    actor.act({ kind: 'sim', action }, 1, ({ detail }) => said.push(detail));
  expect(said).toEqual(['the lights are on', 'the lights are off', 'the horn has sounded']);
});

it.each([
  [{}, {}, null],
  [{}, { mayDrive: false }, 'not-permitted'],
  [{ holdsLease: false }, { mayDrive: false }, 'not-permitted'],
  [{}, { drives: false }, 'not-driver'],
  [{ holdsLease: false }, { drives: false }, null],
  [{}, { estop: true }, null],
  [{ whileStopped: false }, { estop: true }, 'estop'],
  [{ whileStopped: false }, { estop: true, drives: false }, 'not-driver'],
] as const)('a command with %j is barred for an operator with %j: %s', (rules, standing, bar) => {
  expect(barOf({ ...lights, ...rules }, { mayDrive: true, drives: true, estop: false, ...standing })).toBe(
    bar,
  );
});
