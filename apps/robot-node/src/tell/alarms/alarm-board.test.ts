import { decodeJson, encodeJson, robotSessionCodec } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { AlarmBoard } from './alarm-board.ts';

const rules = [
  {
    ...{ watches: 'charge', label: 'Battery', unit: '%', hysteresis: 2 },
    ...{ low: { warn: 20, error: 10 }, text: 'The battery is low' },
  },
  { watches: 'speed', label: 'Speed', unit: 'm/s', hysteresis: 0, high: { warn: 0.5 } },
];

describe('AlarmBoard', () => {
  it('tells each change once, and lists what is raised', () => {
    const board = new AlarmBoard(rules);
    board.take('charge', 50, 1);
    board.take('unknown', -1, 1);
    expect(board.changes()).toEqual([]);
    board.take('charge', 19, 2);
    board.take('charge', 18, 3);
    const raised = {
      ...{ type: 'alarm', number: 0, level: 'warn', text: 'The battery is low' },
      ...{ value: 19, limit: 20, unit: '%', sinceMs: 2 },
    };
    expect(board.changes()).toEqual([raised]);
    expect(board.changes()).toEqual([]);
    expect(board.raised).toEqual([raised]);
    board.take('charge', 23, 4);
    expect(board.changes()).toMatchObject([{ number: 0, level: 'ok', value: 23, limit: 20 }]);
    expect(board.raised).toEqual([]);
  });

  it('says in words what is wrong where the configuration does not', () => {
    const board = new AlarmBoard(rules);
    board.take('speed', 0.75, 1);
    const [alarm] = board.changes();
    expect(alarm).toMatchObject({ number: 1, text: 'Speed is too high', limit: 0.5 });
    expect(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, alarm!))).toEqual(alarm);
  });

  it('is told at most as often as asked, and not at all if it was raised and cleared in between', () => {
    const board = new AlarmBoard(rules);
    board.take('speed', 1, 1);
    board.take('speed', 0, 2);
    expect(board.changes()).toEqual([]);
    for (let i = 0; i < 101; i++) board.take('speed', i % 2 === 0 ? 1 : 0, i);
    expect(board.changes()).toMatchObject([{ level: 'warn' }]);
  });
});
