import { describe, expect, it } from 'vitest';
import { cellStop } from './stop-all.ts';
import type { CellState } from './wall-messages.ts';

const cell: CellState = {
  ...{ farpoint: 'cell', robot: 'rover', name: 'Rover', live: true, drives: false, stopped: false, heard: 0 },
};
const pressed = { press: 2, atMs: 1000 };

describe('STOP of the wall', () => {
  it('says nothing before it is pressed, and of a page without a robot', () => {
    expect(cellStop(cell, { press: 0, atMs: 0 }, 5000)).toBe('none');
    expect(cellStop({ ...cell, robot: null, heard: 2 }, pressed, 5000)).toBe('none');
  });

  it('is confirmed by the robot only', () => {
    const heard = { ...cell, heard: 2 };
    expect(cellStop(heard, pressed, 1999)).toBe('asked');
    expect(cellStop(heard, pressed, 2000)).toBe('unconfirmed');
    expect(cellStop({ ...heard, stopped: true }, pressed, 1100)).toBe('stopped');
  });

  it('names a page that does not hear, also one that heard an earlier press', () => {
    for (const deaf of [null, cell, { ...cell, heard: 1, stopped: true }]) {
      expect(cellStop(deaf, pressed, 1499)).toBe('asked');
      expect(cellStop(deaf, pressed, 1500)).toBe('unheard');
    }
  });
});
