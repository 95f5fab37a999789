import type { NearSector } from '@farpoint/operator';
import { describe, expect, test } from 'vitest';
import { directionOf } from '../ground/near-field/directions.ts';
import { nearDetails, nearWords } from './near-words.ts';

const OPEN: NearSector = { hit: null, unseen: null };

/** The sectors, with these in place of some. */
function view(changes: Record<number, Partial<NearSector>>, ageMs = 0) {
  const sectors = Array.from({ length: 72 }, (_, i) => ({ ...OPEN, ...changes[i] }));
  return { sectors, ageMs, stale: ageMs > 1000 };
}

const thing = (metres: number) => ({ hit: { kind: 'thing' as const, metres } });
const drop = (metres: number) => ({ hit: { kind: 'drop' as const, metres } });

test('directions are named by eighths of the circle, ahead being the middle of the first', () => {
  const names = [0, 4, 5, 9, 13, 18, 27, 36, 45, 54, 63, 67, 68, 71].map((sector) => directionOf(sector, 72));
  expect(names).toEqual([
    ...['ahead', 'ahead', 'ahead left', 'ahead left', 'ahead left', 'left', 'behind left', 'behind'],
    ...['behind right', 'right', 'ahead right', 'ahead right', 'ahead', 'ahead'],
  ]);
});

describe('what is nearest', () => {
  test('is named in metres with its direction, as urgent as it is near', () => {
    expect(nearWords(view({ 0: thing(2), 9: thing(0.3) }))).toEqual({
      text: '0.3 m ahead left',
      tone: 'bad',
    });
    expect(nearWords(view({ 18: thing(0.7) }))).toEqual({ text: '0.7 m left', tone: 'warning' });
    expect(nearWords(view({ 36: thing(2.5) }))).toEqual({ text: '2.5 m behind', tone: 'neutral' });
    expect(nearWords(view({ 0: thing(0.025) })).text).toBe('At its edge, ahead');
  });

  test('is called a drop where the floor is missing', () => {
    expect(nearWords(view({ 1: drop(1.5) }))).toEqual({ text: 'Drop 1.5 m ahead', tone: 'warning' });
  });

  test('that nothing is near is said only of what sensors see', () => {
    expect(nearWords(view({}))).toEqual({ text: 'Nothing near that sensors see', tone: 'neutral' });
  });

  test('old news says how old it is; without any, that is said', () => {
    expect(nearWords(view({ 0: thing(0.3) }, 2100))).toEqual({
      text: '2 s old: 0.3 m ahead',
      tone: 'warning',
    });
    expect(nearWords(null)).toEqual({ text: 'No near-field data', tone: 'warning' });
  });
});

describe('what else there is', () => {
  const unseen = (from: number, to: number, fromM = 0, toM = 2) =>
    Object.fromEntries(Array.from({ length: to - from }, (_, i) => [from + i, { unseen: { fromM, toM } }]));

  test('names two more directions, and where nothing is seen', () => {
    const all = { 0: thing(0.3), 18: thing(0.5), 36: thing(0.9), 54: thing(0.6), 27: thing(1.2) };
    expect(nearDetails(view(all))).toBe('0.5 m left · 0.6 m right');
    expect(nearDetails(view({ ...unseen(14, 59), 0: thing(0.3) }))).toBe('unseen: left, behind, right');
    expect(nearDetails(view(unseen(5, 68)))).toBe('unseen: ahead left, left, behind, right, ahead right');
    expect(nearDetails(view(unseen(5, 59)))).toBe('unseen: ahead left, left, behind, right');
    expect(nearDetails(view(unseen(0, 72)))).toBe('unseen all around');
    expect(nearDetails(null)).toBe('');
  });

  test('floor behind a thing, and far away, is not called unseen', () => {
    const hidden = { ...thing(0.2), unseen: { fromM: 0.3, toM: 2 } };
    const left = Object.fromEntries(Array.from({ length: 9 }, (_, i) => [14 + i, hidden]));
    expect(nearDetails(view(left))).toBe('');
    expect(nearDetails(view(unseen(14, 23, 0.8)))).toBe('');
    // The floor just before the robot is out of its camera's view.
    expect(nearDetails(view(unseen(68, 72, 0, 0.5)))).toBe('');
  });
});
