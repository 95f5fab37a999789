import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { ActionPort, CommandActor, CommandOrder } from './command-actor.ts';
import type { CommandOptions } from './command-configuration.ts';
import { type CommandRunInfo, CommandRuns } from './command-runs.ts';

const lights: CommandOptions = {
  ...{ id: 'lights', label: 'Lights', confirm: false, who: 'driver', standing: false, onStop: 'cancel' },
  ...{ perSecond: 1, timeoutMs: 1000, action: { kind: 'sim', action: 'lights' } },
};
const GIVER = { session: 'a', name: 'Ann', request: 1, text: '' };

/** Ends when it is told to. */
class Actor implements CommandActor {
  readonly asked: ActionPort[] = [];
  cancels = 0;
  closed = 0;
  readonly #canCancel: boolean;
  constructor(canCancel: boolean) {
    this.#canCancel = canCancel;
  }
  begin(_: CommandOrder, port: ActionPort): (() => void) | null {
    this.asked.push(port);
    return this.#canCancel ? () => this.cancels++ : null;
  }
  async close(): Promise<void> {
    this.closed++;
  }
}

function bench({ canCancel = true }, ...commands: CommandOptions[]) {
  const clock = { nowMs: 0 };
  const actor = new Actor(canCancel);
  const told: string[] = [];
  const runs = new CommandRuns(
    commands,
    () => actor,
    () => clock.nowMs,
    ({ run, state, progress, detail }: CommandRunInfo) =>
      told.push([run, state, progress ?? '', detail].filter((each) => each !== '').join(' ')),
  );
  const pass = (ms: number) => {
    clock.nowMs += ms;
    runs.update();
  };
  return { actor, told, runs, pass, clock, give: (id: string) => runs.give(id, GIVER) };
}

describe('the robot’s commands', () => {
  it('are begun, progress, and end', () => {
    const { actor, told, runs, pass, give } = bench({}, lights);
    expect(give('lights')).toBeNull();
    actor.asked[0]?.progress(0.25, 'one');
    pass(25);
    expect(told).toEqual(['1 running']);
    pass(175);
    actor.asked[0]?.progress(7, 'two');
    pass(25);
    expect(told.slice(1)).toEqual(['1 running 0.25 one']);
    pass(175);
    expect(told.slice(2)).toEqual(['1 running 1 two']);
    actor.asked[0]?.end({ state: 'done', detail: 'on' });
    pass(1000);
    give('lights');
    actor.asked[1]?.end({ state: 'failed', detail: `no\u0000\n${'x'.repeat(500)}` });
    expect(told.slice(3)).toEqual(['1 done on', '2 running', `2 failed no ${'x'.repeat(197)}`]);
    expect([...runs.begun.entries()]).toEqual([['lights', 2]]);
    expect(runs.open).toEqual([]);
  });

  it('are nothing but those of the configuration', () => {
    const { actor, give } = bench({}, lights);
    for (const id of ['light', 'lights ', '', '__proto__', 'constructor']) expect(give(id)).toBe('unknown');
    expect(actor.asked).toEqual([]);
  });

  it('are given one at a time, and not too often', () => {
    const { actor, give, pass } = bench({}, lights, { ...lights, id: 'horn' });
    expect(give('lights')).toBeNull();
    expect(give('lights')).toBe('busy');
    expect(give('horn')).toBeNull();
    actor.asked[0]?.end({ state: 'done', detail: '' });
    expect(give('lights')).toBe('too-often');
    pass(999);
    expect(give('lights')).toBe('too-often');
    pass(1);
    expect(give('lights')).toBeNull();
  });

  it('end after their time, once, and an answer that comes later ends no other', () => {
    const { actor, told, give, pass } = bench({}, lights);
    give('lights');
    pass(999);
    expect(told).toEqual(['1 running']);
    pass(1);
    expect(told.slice(1)).toEqual(['1 timed-out']);
    expect(actor.cancels).toBe(1);
    give('lights');
    actor.asked[0]?.end({ state: 'done', detail: 'late' });
    expect(told.slice(2)).toEqual(['2 running']);
    actor.asked[1]?.end({ state: 'done', detail: 'in time' });
    actor.asked[1]?.end({ state: 'failed', detail: 'twice' });
    expect(told.slice(3)).toEqual(['2 done in time']);
  });

  it('are cancelled once what does them says so, or after two seconds; what is done nevertheless is done', () => {
    const { actor, told, runs, give, pass } = bench({}, { ...lights, timeoutMs: 60_000, perSecond: 10 });
    const ask = () => {
      give('lights');
      return runs.cancel(told.filter((line) => line.endsWith('running')).length, 'Bob');
    };
    expect(runs.cancel(1, 'Bob')).toBe('unknown');
    expect(ask()).toBeNull();
    expect([runs.cancel(1, 'Eve'), actor.cancels]).toEqual([null, 1]);
    actor.asked[0]?.end({ state: 'failed', detail: '' });
    ask();
    actor.asked[1]?.end({ state: 'done', detail: 'before that' });
    ask();
    pass(1999);
    expect(runs.open).toHaveLength(1);
    pass(1);
    expect(told.filter((line) => !line.endsWith('running'))).toEqual([
      '1 cancelled by Bob',
      '2 done before that',
      '3 cancelled by Bob; nothing has confirmed it',
    ]);
  });

  it('that cannot be cancelled are refused to be', () => {
    const { runs, give } = bench({ canCancel: false }, lights);
    give('lights');
    expect(runs.cancel(1, 'Bob')).toBe('not-cancellable');
  });

  it('are cancelled by STOP, unless they are to go on', async () => {
    const going = { ...lights, id: 'horn', onStop: 'continue' } as const;
    const { actor, told, runs, give } = bench({}, lights, going);
    give('horn');
    give('lights');
    runs.stop();
    runs.stop();
    expect(actor.cancels).toBe(1);
    actor.asked[1]?.end({ state: 'cancelled', detail: '' });
    expect(told.slice(2)).toEqual(['2 cancelled by STOP']);
    expect(runs.open.map(({ command }) => command.id)).toEqual(['horn']);
    await runs.close();
    expect([actor.cancels, actor.closed]).toEqual([2, 1]);
    const other = bench({ canCancel: false }, lights);
    other.give('lights');
    other.runs.stop();
    expect(other.told[1]).toBe('1 cancelled by STOP; it may be done or not');
  });

  it('never exceed their rate, whoever gives them and whenever', () => {
    const gaps = fc.array(fc.integer({ min: 0, max: 700 }), { maxLength: 60 });
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 4 }), gaps, (perSecond, all) => {
        const { actor, give, pass, clock } = bench({}, { ...lights, perSecond });
        for (const gap of all) {
          pass(gap);
          if (give('lights') === null) actor.asked.at(-1)?.end({ state: 'done', detail: '' });
        }
        expect(actor.asked.length).toBeLessThanOrEqual(perSecond + (clock.nowMs / 1000) * perSecond);
      }),
      { seed: 1, numRuns: 100 },
    );
  });
});
