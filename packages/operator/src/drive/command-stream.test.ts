import { type Command, isZeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { CommandStream, STOP_REPEATS } from './command-stream.ts';

const limits = { maxLinear: 1, maxAngular: 2, watchdogMs: 150, maxCommandsPerSecond: 100 };
const forward = { forward: 1, left: 0 };

function leased(): CommandStream {
  const stream = new CommandStream();
  stream.setLimits(limits);
  stream.setLease('lease');
  return stream;
}

function run(stream: CommandStream, fromMs: number, toMs: number, stepMs = 5): Command[] {
  const commands: Command[] = [];
  for (let now = fromMs; now < toMs; now += stepMs) {
    const command = stream.due(now);
    if (command !== null) commands.push(command);
  }
  return commands;
}

describe('CommandStream', () => {
  test('while the grip is held: 40 commands a second, in sequence, with the wish', () => {
    const stream = leased();
    stream.set('held', forward);
    const commands = run(stream, 0, 1000);
    expect(commands).toHaveLength(40);
    expect(commands.map((command) => command.sequence)).toEqual(Array.from({ length: 40 }, (_, i) => i + 1));
    for (const command of commands) {
      expect(command).toMatchObject({ lease: 'lease', deadMan: true, twist: { linear: { x: 1 } } });
    }
  });

  test('when the grip is released: a few zero commands, the first at once, then nothing', () => {
    const stream = leased();
    stream.set('held', forward);
    run(stream, 0, 100);
    stream.set('open', forward);
    const first = stream.due(101);
    expect(first?.deadMan).toBe(false);
    const rest = run(stream, 105, 2000);
    expect(rest).toHaveLength(STOP_REPEATS - 1);
    for (const command of [first!, ...rest]) expect(isZeroTwist(command.twist)).toBe(true);
    expect(stream.active).toBe(false);
  });

  test('when the grip is not read: a few commands that say so, then nothing until it is read or let go', () => {
    const stream = leased();
    stream.set('held', forward, 0);
    run(stream, 0, 100);
    stream.set('unread', forward, 0);
    const told = run(stream, 101, 1000);
    expect(told).toHaveLength(STOP_REPEATS);
    for (const { unread, deadMan, twist, timeMs } of told) {
      expect([unread, deadMan, isZeroTwist(twist)]).toEqual([true, true, true]);
      // It says what is known now, and not of the hand.
      expect(timeMs).toBeGreaterThan(100);
    }
    stream.set('held', forward, 1000);
    expect(stream.due(1001)).toMatchObject({ deadMan: true, twist: { linear: { x: 1 } } });
    stream.set('unread', forward, 1000);
    stream.due(1101);
    stream.set('open', forward, null);
    expect(run(stream, 1102, 2000).map(({ deadMan, unread }) => [deadMan, unread])).toEqual(
      Array.from({ length: STOP_REPEATS }, () => [false, undefined]),
    );
  });

  test('without a lease nothing is sent, and nothing is made up for later', () => {
    const stream = new CommandStream();
    stream.setLimits(limits);
    stream.set('held', forward);
    expect(run(stream, 0, 500)).toEqual([]);
    stream.set('open', forward);
    expect(run(stream, 500, 600)).toEqual([]);
    stream.setLease('lease');
    expect(run(stream, 600, 700)).toEqual([]);
  });

  test('stays below the robot’s command rate', () => {
    const stream = leased();
    stream.setLimits({ ...limits, maxCommandsPerSecond: 10 });
    stream.set('held', forward);
    expect(run(stream, 0, 10_000).length).toBeLessThanOrEqual(83);
  });

  test('does not catch up after a pause', () => {
    const stream = leased();
    stream.set('held', forward);
    run(stream, 0, 100);
    expect(stream.due(5000)).not.toBe(null);
    expect(stream.due(5001)).toBe(null);
  });

  test('a latency test is an extra command with the current wish', () => {
    const stream = leased();
    expect(stream.latencyTest(3, 7)).toMatchObject({
      sequence: 1,
      latencyTest: 7,
      deadMan: false,
      timeMs: 3,
    });
    stream.set('held', forward);
    stream.due(10);
    expect(stream.latencyTest(11, 8)).toMatchObject({
      sequence: 3,
      deadMan: true,
      twist: { linear: { x: 1 } },
    });
    stream.setLease(null);
    expect(stream.latencyTest(12, 9)).toBe(null);
  });

  test('a new session begins with the grip released', () => {
    const stream = leased();
    stream.set('held', forward);
    stream.due(0);
    stream.reset();
    stream.setLimits(limits);
    stream.setLease('other');
    expect(stream.due(100)).toBe(null);
    stream.set('held', forward);
    expect(stream.due(200)?.sequence).toBe(1);
  });

  test('motion is only requested while the grip is held', () => {
    const step = fc.record({ held: fc.boolean(), forward: fc.double(), left: fc.double(), ms: fc.nat(80) });
    fc.assert(
      fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
        const stream = leased();
        let now = 0;
        let last = 0;
        for (const { held, forward, left, ms } of steps) {
          stream.set(held ? 'held' : 'open', { forward, left });
          now += ms;
          const command = stream.due(now);
          if (command === null) continue;
          expect(command.sequence).toBe(++last);
          expect(command.deadMan).toBe(held);
          if (!held) expect(isZeroTwist(command.twist)).toBe(true);
        }
      }),
      { seed: 4 },
    );
  });
});
