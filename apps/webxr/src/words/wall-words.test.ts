import { describe, expect, it } from 'vitest';
import type { CellState } from '../ground/wall/wall-messages.ts';
import { cellWords, stopAllWords } from './wall-words.ts';

const cell: CellState = {
  ...{ farpoint: 'cell', robot: 'rover', name: 'Rover', live: true, drives: false, stopped: false, heard: 0 },
};

describe('a page’s heading', () => {
  it.each([
    [null, 'none', false, 'This page does not respond.'],
    [cell, 'none', true, 'This page does not respond.'],
    [{ ...cell, robot: null }, 'none', false, 'No robot is selected.'],
    [{ ...cell, live: false }, 'none', false, 'Not connected.'],
    [cell, 'none', false, 'Live'],
    [{ ...cell, drives: true }, 'none', false, 'You are driving.'],
    [{ ...cell, stopped: true }, 'stopped', false, 'Emergency stop is on.'],
    [{ ...cell, drives: true }, 'unconfirmed', false, 'The robot has not confirmed STOP.'],
    [{ ...cell, live: false }, 'unconfirmed', false, 'The robot has not confirmed STOP.'],
    [cell, 'unheard', true, 'This page did not receive STOP: use the robot’s own stop.'],
  ] as const)('%o, STOP %s, silent %s: %s', (state, stop, silent, text) => {
    expect(cellWords(state, stop, silent).text).toBe(text);
  });
});

describe('the line beside STOP ALL', () => {
  it.each([
    [['none', 'none'], undefined],
    [['stopped', 'none'], 'STOP: 1 robot stopped.'],
    [['stopped', 'stopped'], 'STOP: 2 robots stopped.'],
    [['stopped', 'asked'], 'Stopping…'],
    [['stopped', 'unconfirmed'], 'STOP: not confirmed by 1 robot.'],
    [['unheard', 'unconfirmed', 'stopped'], 'STOP: 1 of 3 pages did not receive it.'],
  ] as const)('%o: %s', (stops, text) => {
    expect(stopAllWords(stops)?.text).toBe(text);
  });
});
