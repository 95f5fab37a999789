import { expect, test } from 'vitest';
import { DiagnosticBoard } from './diagnostic-board.ts';

const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };
const message = (...status: [number, string, string][]) => ({
  header,
  status: status.map(([level, name, text]) => ({ level, name, message: text })),
});

test('each component keeps its last report, and the time since which it has its level', () => {
  const board = new DiagnosticBoard();
  board.take(message([0, 'imu', 'fine'], [1, 'motor', 'warm']), 1000);
  board.take(message([1, 'motor', 'warmer']), 2000);
  board.take(message([2, 'motor', 'hot']), 3000);
  expect(board.components).toEqual([
    { name: 'imu', level: 'ok', message: 'fine', sinceMs: 1000 },
    { name: 'motor', level: 'error', message: 'hot', sinceMs: 3000 },
  ]);
});

test('a component that reports nothing becomes stale, and recovers', () => {
  const board = new DiagnosticBoard();
  board.take(message([0, 'imu', 'fine'], [0, 'lidar', 'fine']), 0);
  const { status } = board.take(message([0, 'imu', 'fine']), 12_000);
  expect(status).toMatchObject([{ level: 0 }, { name: 'lidar', level: 3, message: '' }]);
  expect(board.components[1]).toMatchObject({ name: 'lidar', level: 'stale', sinceMs: 10_000 });
  board.take(message([0, 'lidar', 'fine']), 13_000);
  expect(board.components[1]).toMatchObject({ level: 'ok', message: 'fine', sinceMs: 13_000 });
});
