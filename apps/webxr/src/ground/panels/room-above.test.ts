import { describe, expect, test } from 'vitest';
import { roomAbove } from './room-above.ts';

const box = { left: 14, right: 244, top: 400 };
const pills = { left: 18, right: 180, top: 620 };
const stop = { left: 1160, right: 1262, top: 500 };

describe('roomAbove', () => {
  test('ends above what is below, not above what is beside', () => {
    expect(roomAbove(box, [pills, stop], 720)).toBe(212);
  });

  test('ends at the edge of the screen if nothing is below', () => {
    expect(roomAbove(box, [stop], 720)).toBe(312);
    expect(roomAbove(box, [], 720)).toBe(312);
  });

  test('follows what is above it: further down, it is as much lower', () => {
    expect(roomAbove({ ...box, top: 460 }, [pills], 720)).toBe(152);
  });

  test('leaves two rows where there is no room', () => {
    expect(roomAbove({ ...box, top: 600 }, [pills], 720)).toBe(68);
  });
});
