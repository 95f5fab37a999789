import { describe, expect, it } from 'vitest';
import { ReadingBoard } from './reading-board.ts';

const reading = (topic: string, value = 'x') => ({
  ...{ topic, label: topic, level: 'ok' as const },
  values: [['', value]] as [string, string][],
});

describe('ReadingBoard', () => {
  it('returns a new reading immediately and once, and repeats it later with its age', () => {
    const board = new ReadingBoard();
    expect(board.next(0)).toBeNull();
    board.add(reading('/a'), 100);
    expect(board.next(150)).toMatchObject({ type: 'reading', topic: '/a', ageMs: 50 });
    expect(board.next(200)).toBeNull();
    expect(board.next(2149)).toBeNull();
    expect(board.next(2150)).toMatchObject({ topic: '/a', ageMs: 2050 });
    board.add(reading('/a', 'newer'), 2160);
    expect(board.next(2170)).toMatchObject({ values: [['', 'newer']] });
  });

  it('gives every topic its turn, however often one is updated', () => {
    const board = new ReadingBoard();
    for (const topic of ['/a', '/b', '/c']) board.add(reading(topic), 0);
    const told: string[] = [];
    for (let i = 0; i < 9; i++) {
      board.add(reading('/a'), i * 50);
      told.push(board.next(i * 50)?.topic ?? '-');
    }
    expect(told.slice(0, 3).sort()).toEqual(['/a', '/b', '/c']);
    expect(told.slice(3)).toEqual(['/a', '/a', '/a', '/a', '/a', '/a']);
  });

  it('keeps a bounded number of topics', () => {
    const board = new ReadingBoard();
    for (let i = 0; i < 1000; i++) board.add(reading(`/${i}`), 0);
    let told = 0;
    while (board.next(0) !== null) told++;
    expect(told).toBe(64);
  });
});
