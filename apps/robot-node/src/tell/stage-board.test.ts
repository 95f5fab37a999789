import { encodeJson, MOST_STAGE_ROWS, MOST_STAGE_US, stampUsOf, telemetryCodec } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { StageBoard } from './stage-board.ts';

const at = (capturedAtMs: number, ...[memory, ready, first, last]: number[]) => ({
  capturedAtMs,
  inMemoryMs: capturedAtMs + (memory as number),
  readyMs: capturedAtMs + (ready as number),
  firstLeftMs: capturedAtMs + (first as number),
  lastLeftMs: capturedAtMs + (last as number),
});

it('tells of frames since their capture, and of commands since they came', () => {
  const board = new StageBoard();
  expect(board.due(5000, false)).toBe(null);
  board.frame(0, 901, at(1000.5, 4, 31.25, 32.1, 58.4));
  board.command(17, 2000, 2000.04, 2000.095);
  board.command(18, 2025, 2025.04, null);
  expect(board.due(5000, false)).toEqual({
    type: 'stages',
    frames: [[0, 901, 1_000_500, 4000, 31_250, 32_100, 58_400]],
    commands: [
      [17, 2_000_000, 40, 95],
      [18, 2_025_000, 40, null],
    ],
  });
  expect(board.due(9000, false)).toBe(null);
});

it('tells four times a second, and a narrow path once, of the newest', () => {
  const board = new StageBoard();
  const told = (isNarrow: boolean, seconds: number) => {
    const rows: number[] = [];
    for (let ms = 0; ms < seconds * 1000; ms += 25) {
      board.frame(0, ms, at(ms, 1, 2, 3, 4));
      const message = board.due(ms + 100_000 * (isNarrow ? 1 : 2), isNarrow);
      if (message !== null) rows.push(message.frames.length);
    }
    return rows;
  };
  expect(told(true, 4)).toEqual([1, 8, 8, 8]);
  expect(told(false, 2)).toEqual([32, 10, 10, 10, 10, 10, 10, 10]);
});

it('forgets the oldest of what it cannot tell', () => {
  const board = new StageBoard();
  for (let i = 0; i < 100; i++) {
    board.frame(0, i, at(i, 1, 2, 3, 4));
    board.command(i, i, i, i);
  }
  const message = board.due(1000, false);
  expect([message?.frames.length, message?.frames[0]?.[1]]).toEqual([MOST_STAGE_ROWS, 68]);
  expect([message?.commands.length, message?.commands[0]?.[0]]).toEqual([MOST_STAGE_ROWS, 68]);
  board.command(1, 1, 1, 1);
  board.clear();
  expect(board.due(9000, false)).toBe(null);
});

it('whatever the clocks say, every message is one, with the stations in order', () => {
  const ms = fc.double({ min: -1e5, max: 1e7, noNaN: true });
  const start = fc.double({ min: 0, max: 1e10, noNaN: true });
  fc.assert(
    fc.property(start, ms, ms, ms, ms, fc.boolean(), (captured, memory, ready, first, last, refused) => {
      const board = new StageBoard();
      for (let i = 0; i < MOST_STAGE_ROWS; i++) {
        board.frame(7, 0xffffffff, at(captured, memory, ready, first, last));
        board.command(0xffffffff, captured, captured + memory, refused ? null : captured + last);
      }
      const message = board.due(1, false);
      expect(message).not.toBe(null);
      if (message === null) return;
      encodeJson(telemetryCodec, message);
      const [, , stamp, ...stations] = message.frames[0] as [number, number, number, ...number[]];
      expect(stamp).toBe(stampUsOf(captured));
      expect(stations).toEqual([...stations].sort((a, b) => a - b));
      expect(stations.every((us) => us >= 0 && us <= MOST_STAGE_US)).toBe(true);
    }),
    { seed: 21 },
  );
});
