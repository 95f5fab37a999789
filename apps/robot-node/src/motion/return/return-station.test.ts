import { zeroTwist } from '@farpoint/protocol';
import { defaultReturnOptions } from '@farpoint/safety';
import { describe, expect, test } from 'vitest';
import { BaseOdometry } from '../../sense/base/base-odometry.ts';
import { newestHeardMs, ReturnStation } from './return-station.ts';

const FACTS = { driven: false, leased: false, latched: false, wheels: true };
const STEP_MS = 25;

function at(x: number, timeMs: number) {
  const orientation = { x: 0, y: 0, z: 0, w: 1 };
  return {
    ...{ pose: { position: { x, y: 0, z: 0 }, orientation }, twist: zeroTwist(), battery: null },
    ...{ contact: false, timeMs },
  };
}

/** A robot whose wheels do at once what they are told. */
function station(isSimulated = true) {
  const [lines, audited]: [string[], unknown[][]] = [[], []];
  const say = (_: unknown, line?: string) => void lines.push(line ?? '');
  const returns = new ReturnStation(
    { options: { ...defaultReturnOptions }, topic: null },
    {
      limits: { maxLinear: 1, maxAngular: 1.5 },
      lookout: { live: () => true, sees: () => true },
      audit: { returned: (...entry) => void audited.push(entry) },
      log: { info: say, warn: say },
    },
  );
  const odometry = new BaseOdometry({ maxLinear: 1, maxAngular: 1.5 }, isSimulated);
  const robot = { x: 0, nowMs: 0, heardMs: 0 };
  /** @param speed of a driver, m/s; `null`: nobody is there */
  const run = (seconds: number, speed: number | null) => {
    let stops = 0;
    for (let t = 0; t < seconds * 1000; t += STEP_MS) {
      robot.nowMs += STEP_MS;
      if (speed !== null) robot.heardMs = robot.nowMs;
      odometry.take(at(robot.x, robot.nowMs));
      if (returns.update(odometry, robot.heardMs)) stops++;
      const wish = returns.drive.wishAt(robot.nowMs, { ...FACTS, driven: (speed ?? 0) !== 0 });
      robot.x += ((speed ?? wish?.linear.x ?? 0) * STEP_MS) / 1000;
    }
    return stops;
  };
  return { returns, robot, run, lines, audited };
}

describe('the way back', () => {
  test('is told, counted and recorded', () => {
    const { returns, robot, run, lines, audited } = station();
    run(4, 0.5);
    run(16, null);
    expect(returns.begun).toBe(1);
    expect(returns.told?.phase).toBe('returning');
    expect(returns.metres).toBeGreaterThan(0.4);
    // An operator is there again.
    expect(run(0.1, 0)).toBe(1);
    const { metres } = returns.drive;
    expect(returns.told).toEqual({ phase: 'ended', metres, end: 'service-back' });
    expect([...returns.ends.entries()]).toEqual([['service-back', 1]]);
    expect(returns.metres).toBe(metres);
    expect(robot.x).toBeCloseTo(2 - metres, 1);
    expect(audited).toEqual([
      [null, 0],
      ['service-back', Math.round(metres * 100) / 100],
    ]);
    expect(lines).toEqual([
      'no operator is heard: the robot will drive back along its track',
      'drives back along its track',
      'does not drive back any more',
    ]);
  });

  test('is not known to a robot whose pose has no time of its own', () => {
    const { returns, run } = station(false);
    run(4, 0.5);
    run(16, null);
    expect(returns.drive.end).toBe('odometry-silent');
  });
});

test('of all operators, the newest counts', () => {
  expect(newestHeardMs([{ heardMs: 3 }, null, { heardMs: 7 }, undefined])).toBe(7);
  expect(newestHeardMs([])).toBe(Number.NEGATIVE_INFINITY);
});
