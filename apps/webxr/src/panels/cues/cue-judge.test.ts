import type { Intervention, MotionState } from '@farpoint/protocol';
import { beforeEach, expect, test } from 'vitest';
import { CueJudge, type DrivenState } from './cue-judge.ts';

let judge: CueJudge;
beforeEach(() => {
  judge = new CueJudge();
  judge.next(state(), 0);
});

function state(more: Partial<DrivenState> = {}): DrivenState {
  return { driving: true, latched: false, drive: 'driving', motion: undefined, ...more };
}

function moves(factor: number, ...reasons: Intervention[]): DrivenState {
  const motion: MotionState = { factor, reasons, mostLinear: 1 };
  return state({ motion });
}

test('each intervention is told once, when it begins; a stricter one is told again', () => {
  expect(judge.next(moves(0.5, 'obstacle-near'), 100)).toBe('slower');
  expect(judge.next(moves(0.3, 'obstacle-near'), 150)).toBe(null);
  expect(judge.next(moves(0, 'obstacle', 'obstacle-near'), 200)).toBe('held');
  expect(judge.next(moves(0, 'obstacle'), 250)).toBe(null);
  expect(judge.next(moves(0, 'drop-off'), 300)).toBe('held');
});

test('nothing is told when the robot may go faster again', () => {
  judge.next(moves(0, 'obstacle'), 100);
  expect(judge.next(moves(0.2, 'obstacle-near'), 5000)).toBe(null);
  expect(judge.next(moves(1), 5100)).toBe(null);
});

test('what comes and goes at the edge of a zone is told once within 1.5 s', () => {
  const told: (string | null)[] = [];
  for (let ms = 0; ms < 3000; ms += 100)
    told.push(judge.next(ms % 200 === 0 ? moves(0.5, 'fence-near') : moves(1), 1000 + ms));
  expect(told.filter((cue) => cue !== null)).toEqual(['slower', 'slower']);
});

test('bounds that last in ordinary driving are silent, until the robot is held', () => {
  for (const reason of ['blind-travel', 'unseen-space', 'sensor-silent'] as const) {
    expect(judge.next(moves(0.5, reason), 100)).toBe(null);
  }
  expect(judge.next(moves(0, 'view-lost'), 200)).toBe('held');
});

test('who does not drive hears the emergency stop only, whoever has latched it', () => {
  expect(judge.next({ ...moves(0, 'obstacle'), driving: false }, 100)).toBe(null);
  expect(judge.next(state({ driving: false, latched: true, drive: 'estop' }), 200)).toBe('stop');
  expect(judge.next(state({ driving: false, latched: true, drive: 'estop' }), 300)).toBe(null);
  judge.next(state({ driving: false }), 400);
  expect(judge.next(state({ driving: false, latched: true, drive: 'estop' }), 500)).toBe('stop');
});

test('a stop that was on before the page came is not told, nor what it does to the wish', () => {
  const fresh = new CueJudge();
  expect(fresh.next({ ...moves(0, 'obstacle'), latched: true, drive: 'estop' }, 0)).toBe(null);
});

test('a gap that stopped the robot while the grip was held is told', () => {
  expect(judge.next(state({ drive: 'watchdog' }), 100)).toBe('held');
});
