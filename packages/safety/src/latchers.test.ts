/** Who counts as having latched the emergency stop, with the policy `latcher`. */
import { beforeEach, describe, expect, test } from 'vitest';
import type { DriveGuard } from './drive-guard.ts';
import { Latchers } from './latchers.ts';
import { makeGuard } from './testing/driven-guard.ts';

let guard: DriveGuard;
beforeEach(() => {
  guard = makeGuard({ estopRelease: 'latcher' });
});

/** What becomes of the release, asked for while driving. */
function release(operatorId: string): string {
  guard.requestLease(operatorId, true, 0, true);
  const outcome = guard.releaseEstop(operatorId);
  return outcome.released ? 'released' : outcome.reason;
}

describe('with subjects', () => {
  test('whoever reconnects is still the one who latched, and others are not', () => {
    guard.identify('s1', 'ada');
    guard.identify('s2', 'bob');
    guard.latchEstop('operator', 's1');
    guard.operatorGone('s1');
    guard.identify('s3', 'ada');
    expect(release('s2')).toBe('not-latcher');
    expect(release('s3')).toBe('released');
  });

  test('another session of the same subject counts, until the last one has left', () => {
    for (const [session, subject] of [
      ['s1', 'ada'],
      ['s2', 'ada'],
      ['s3', 'bob'],
    ] as const)
      guard.identify(session, subject);
    guard.latchEstop('operator', 's1');
    guard.operatorGone('s1');
    expect(release('s3')).toBe('not-latcher');
    guard.operatorGone('s2');
    expect(release('s3')).toBe('released');
  });

  test('a latch from two sessions of one subject is one, and is withdrawn as one', () => {
    guard.identify('s1', 'ada');
    guard.identify('s2', 'ada');
    guard.latchEstop('operator', 's1');
    guard.latchEstop('operator', 's2');
    expect(release('s2')).toBe('released');
  });

  test('others who have latched keep it, wherever they are connected now', () => {
    guard.identify('s1', 'ada');
    guard.identify('s2', 'bob');
    guard.latchEstop('operator', 's1');
    guard.latchEstop('operator', 's2');
    guard.operatorGone('s2');
    guard.identify('s3', 'bob');
    expect(release('s1')).toBe('others-latched');
    expect(release('s3')).toBe('released');
  });

  test('a latch that was released is nobody’s any more', () => {
    guard.identify('s1', 'ada');
    guard.identify('s2', 'bob');
    guard.latchEstop('operator', 's1');
    expect(release('s1')).toBe('released');
    guard.latchEstop('operator', 's2');
    expect(release('s1')).toBe('not-latcher');
  });
});

describe('without subjects', () => {
  test('the session is the operator: another one is another', () => {
    guard.latchEstop('operator', 's1');
    expect(release('s2')).toBe('not-latcher');
    guard.operatorGone('s1');
    expect(release('s2')).toBe('released');
  });

  test('a session with the name of a subject is not that subject', () => {
    guard.identify('s1', 'ada');
    guard.latchEstop('operator', 's1');
    expect(release('ada')).toBe('not-latcher');
  });
});

test('those who are there are never forgotten for those who have left', () => {
  const latchers = new Latchers();
  latchers.identify('here', 'here');
  latchers.add('here');
  for (let n = 0; n < 100; n++) {
    latchers.identify(`s${n}`, `person ${n}`);
    latchers.add(`s${n}`);
    latchers.gone(`s${n}`);
  }
  expect(latchers.present).toBe(1);
  expect(latchers.has('here')).toBe(true);
  latchers.identify('again', 'person 99');
  expect(latchers.present).toBe(2);
});
