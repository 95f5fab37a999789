import type { Intervention, Telemetry } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { LossEvents } from './loss-events.ts';
import { MotionEvents } from './motion-events.ts';

interface Said {
  readonly drive?: Telemetry['drive'];
  readonly factor?: number;
  readonly reasons?: readonly Intervention[];
  readonly letGoFirst?: true;
  readonly guard?: 'on' | 'blind' | 'off';
  readonly rate?: number;
}

/** Tells telemetry every 50 ms. @returns the kinds of what is found */
function setUp() {
  const motion = new MotionEvents();
  let timeMs = 0;
  const tell = (said: Said = {}, forMs = 50) => {
    const { drive = 'driving', factor = 1, reasons = [], letGoFirst, guard, rate = 8_000_000 } = said;
    const found = [];
    for (let told = 0; told < forMs; told += 50) {
      timeMs += 50;
      const telemetry = {
        timeMs,
        drive,
        motion: { factor, reasons, mostLinear: 1, letGoFirst, obstacleGuard: guard },
        stream: { targetBitsPerSecond: rate },
      };
      found.push(...motion.observe(telemetry as unknown as Telemetry));
    }
    return found;
  };
  return { motion, tell };
}

describe('limits of motion', () => {
  test('begin at once, and are over once nothing has limited the robot for a second', () => {
    const { tell } = setUp();
    expect(tell({}, 1000)).toEqual([]);
    expect(tell({ factor: 0.4, reasons: ['view-late'] }, 500)).toEqual([
      { kind: 'slowed', reasons: ['view-late'] },
    ]);
    expect(tell({}, 900)).toEqual([]);
    expect(tell({ factor: 0.5, reasons: ['view-late'] }, 500)).toEqual([]);
    expect(tell({ factor: 0, reasons: ['obstacle', 'view-late'] })).toEqual([
      { kind: 'held', reasons: ['obstacle', 'view-late'] },
    ]);
    expect(tell({ factor: 0, reasons: ['fence'] })).toEqual([{ kind: 'held', reasons: ['fence'] }]);
    expect(tell({}, 950)).toEqual([]);
    expect(tell({}, 50)).toEqual([{ kind: 'free' }]);
    expect(tell({}, 5000)).toEqual([]);
  });

  test('stops by the watchdog, by contact, and until the grip is let go', () => {
    const { tell } = setUp();
    expect(tell({ drive: 'watchdog' }, 500)).toEqual([{ kind: 'watchdog' }]);
    expect(tell({ drive: 'watchdog', letGoFirst: true }, 500)).toEqual([{ kind: 'let-go-first' }]);
    expect(tell({ drive: 'blocked' }, 500)).toEqual([{ kind: 'blocked' }]);
    expect(tell({ drive: 'blocked', factor: 0, reasons: ['obstacle'] }, 500)).toEqual([
      { kind: 'held', reasons: ['obstacle'] },
    ]);
  });

  test('a guard is news when it is not on, and when it is on again', () => {
    const { tell } = setUp();
    expect(tell({ guard: 'on' })).toEqual([]);
    expect(tell({ guard: 'blind' }, 200)).toEqual([{ kind: 'guard-state', state: 'blind' }]);
    expect(tell({ guard: 'on' }, 200)).toEqual([{ kind: 'guard-state', state: 'on' }]);
    expect(setUp().tell({ guard: 'off' }, 200)).toEqual([{ kind: 'guard-state', state: 'off' }]);
  });

  test('telemetry that comes late says nothing', () => {
    const { motion, tell } = setUp();
    tell({}, 1000);
    const late = { timeMs: 500, drive: 'watchdog', stream: { targetBitsPerSecond: 1 } };
    expect(motion.observe(late as unknown as Telemetry)).toEqual([]);
  });
});

describe('the bit rate', () => {
  test('falls when it is below half of what it was, and is back at four fifths', () => {
    const { tell } = setUp();
    tell({ rate: 8_000_000 }, 1000);
    expect(tell({ rate: 4_000_001 }, 50)).toEqual([]);
    expect(tell({ rate: 3_500_000 }, 1000)).toEqual([{ kind: 'rate-fell', fromKbps: 7990, toKbps: 3500 }]);
    expect(tell({ rate: 6_300_000 }, 1000)).toEqual([]);
    expect(tell({ rate: 6_500_000 }, 1000)).toEqual([{ kind: 'rate-recovered', toKbps: 6500 }]);
  });

  test('that declines slowly has not fallen', () => {
    const { tell } = setUp();
    let rate = 8_000_000;
    const found = [];
    for (; rate > 1_000_000; rate *= 0.999) found.push(...tell({ rate }));
    expect(found).toEqual([]);
  });
});

test('packet loss is high from 5 % on, and over below 2 %', () => {
  const losses = new LossEvents();
  expect(losses.observe(0.049)).toBeNull();
  expect(losses.observe(0.05)).toEqual({ kind: 'loss-high', percent: 5 });
  expect(losses.observe(0.2)).toBeNull();
  expect(losses.observe(0.02)).toBeNull();
  expect(losses.observe(0.019)).toEqual({ kind: 'loss-over', percent: 2 });
  losses.observe(0.9);
  losses.reset();
  expect(losses.observe(0)).toBeNull();
});
