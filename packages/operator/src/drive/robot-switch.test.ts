import { describe, expect, test } from 'vitest';
import { LONGEST_WAIT_MS, type PresentRobot, RobotSwitch, robotAfter } from './robot-switch.ts';

const driven: PresentRobot = { robotId: 'a', live: true, holder: 'you', speed: 0.8 };

function bench() {
  const done: string[] = [];
  const change = new RobotSwitch({
    letGo: () => done.push('let go'),
    connect: (robotId) => done.push(`connect ${robotId}`),
  });
  return { done, change };
}

describe('RobotSwitch', () => {
  test('lets go, and connects to the other once the lease is released and the robot has stopped', () => {
    const { done, change } = bench();
    change.choose('b', driven, 0);
    expect(done).toEqual(['let go']);
    change.decide({ ...driven, speed: 0 }, 25); // we still hold the lease
    change.decide({ ...driven, holder: 'nobody' }, 50); // the robot is still moving
    expect([done, change.target]).toEqual([['let go'], 'b']);
    change.decide({ ...driven, holder: 'nobody', speed: 0.01 }, 75);
    expect([done, change.target]).toEqual([['let go', 'connect b'], null]);
    change.decide({ ...driven, robotId: 'b' }, 100);
    expect(done).toHaveLength(2);
  });

  test('does not wait for a robot that somebody else drives', () => {
    for (const present of [
      { ...driven, holder: 'other' as const },
      { ...driven, holder: 'nobody' as const, speed: null },
    ]) {
      const { done, change } = bench();
      change.choose('b', present, 0);
      expect(done).toEqual(['let go', 'connect b']);
    }
  });

  test('connects at once if there is no session', () => {
    const { done, change } = bench();
    change.choose('b', { robotId: null, live: false, holder: 'nobody', speed: null }, 0);
    expect(done).toEqual(['connect b']);
  });

  test('leaves a robot that does not answer after a while, and a lost one at once', () => {
    const silent = bench();
    silent.change.choose('b', driven, 0);
    silent.change.decide(driven, LONGEST_WAIT_MS - 1);
    expect(silent.done).toEqual(['let go']);
    silent.change.decide(driven, LONGEST_WAIT_MS);
    expect(silent.done).toEqual(['let go', 'connect b']);
    const lost = bench();
    lost.change.choose('b', driven, 0);
    lost.change.decide({ ...driven, live: false }, 25);
    expect(lost.done).toEqual(['let go', 'connect b']);
  });

  test('the last choice counts; choosing the present robot or cancelling revokes it', () => {
    const { done, change } = bench();
    change.choose('b', driven, 0);
    change.choose('c', driven, 1000);
    change.decide(driven, LONGEST_WAIT_MS);
    expect(done).toEqual(['let go', 'let go', 'connect c']);
    change.choose('b', driven, 2000);
    change.choose('a', driven, 2025);
    change.choose('c', driven, 3000);
    change.cancel();
    change.decide({ ...driven, live: false }, 9000);
    expect(done.filter((what) => what.startsWith('connect'))).toEqual(['connect c']);
  });
});

test('the robot after this one', () => {
  const [a, b, c] = ['a', 'b', 'c'].map((id) => ({ id, name: id })) as [
    { id: string; name: string },
    { id: string; name: string },
    { id: string; name: string },
  ];
  expect(robotAfter([a, b, c], 'b')).toBe(c);
  expect(robotAfter([a, b, c], 'c')).toBe(a);
  expect(robotAfter([a, b], 'gone')).toBe(a);
  expect(robotAfter([a], 'a')).toBe(null);
  expect(robotAfter([], 'a')).toBe(null);
});
