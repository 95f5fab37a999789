import {
  decodeJson,
  encodeJson,
  MAX_MAP_SIDE,
  type MapTiles,
  type PlannedPath,
  telemetryCodec,
  tileCount,
  writeTile,
} from '@farpoint/protocol';
import type { OccupancyMap } from '@farpoint/ros';
import { beforeEach, describe, expect, it } from 'vitest';
import { NavigationBoard, type PathWidth } from './navigation-board.ts';

const STEP_MS = 50;

/** @param state of a cell, by its place in the list */
function mapOf(width: number, height: number, state: (at: number) => number): OccupancyMap {
  const cells = Uint8Array.from({ length: width * height }, (_, at) => state(at));
  return { width, height, cellM: 0.05, origin: { x: 1, y: 2, yaw: 0.5 }, cells };
}

/** Takes what an operator is told, and puts the map together. */
class Operator {
  readonly paths: PlannedPath[] = [];
  readonly messages: MapTiles[] = [];
  cells = new Uint8Array();
  bytes = 0;

  hear(board: NavigationBoard, width: PathWidth, fromMs: number, toMs: number): void {
    const step = width === 'wide' ? STEP_MS : 4 * STEP_MS;
    for (let nowMs = fromMs; nowMs < toMs; nowMs += step)
      for (const message of board.next(this, width, nowMs)) this.#take(message);
  }

  get tiles(): number {
    return this.messages.reduce((sum, { tiles }) => sum + tiles.length, 0);
  }

  #take(given: PlannedPath | MapTiles): void {
    const text = encodeJson(telemetryCodec, given);
    this.bytes += text.length;
    const message = decodeJson(telemetryCodec, text);
    if (message.type === 'path') this.paths.push(message);
    if (message.type !== 'map') return;
    this.messages.push(message);
    if (this.cells.length !== message.width * message.height)
      this.cells = new Uint8Array(message.width * message.height).fill(255);
    for (const [index, runs] of message.tiles) writeTile(message, index, runs, this.cells);
  }
}

let board: NavigationBoard;
let operator: Operator;
beforeEach(() => {
  board = new NavigationBoard();
  operator = new Operator();
});

describe('a map', () => {
  it('is told whole, soon and in messages that fit, whatever it has', () => {
    const worst = mapOf(MAX_MAP_SIDE, MAX_MAP_SIDE, (at) => at % 4);
    board.take('/map', { kind: 'map', map: worst }, 0);
    operator.hear(board, 'wide', 0, 30_000);
    expect(operator.cells).toEqual(worst.cells);
    expect(operator.tiles).toBeLessThan(tileCount(worst) + 10);
    // A room: long runs.
    const room = mapOf(400, 300, (at) => (at % 400 < 4 ? 3 : 1));
    board.take('/map', { kind: 'map', map: room }, 30_000);
    const other = new Operator();
    other.hear(board, 'wide', 30_000, 31_500);
    expect(other.cells).toEqual(room.cells);
    expect(other.bytes).toBeLessThan(20_000);
  });

  it('takes little of the link: of a wide one at most 200 kbit/s, of a narrow one 50', () => {
    board.take('/map', { kind: 'map', map: mapOf(512, 512, (at) => (at * 7) % 4) }, 0);
    for (const [width, mostBytes] of [
      ['wide', 25_000],
      ['narrow', 6250],
    ] as const) {
      const one = new Operator();
      one.hear(board, width, 0, 10_000);
      expect(one.bytes / 10).toBeLessThan(mostBytes);
      expect(one.messages.length).toBeGreaterThan(20);
    }
  });

  it('that is known is repeated slowly; whoever comes later gets all of it', () => {
    const map = mapOf(200, 100, (at) => (at < 3000 ? 3 : 1));
    board.take('/map', { kind: 'map', map }, 0);
    operator.hear(board, 'wide', 0, 5000);
    const heard = operator.messages.length;
    operator.cells.fill(255);
    operator.hear(board, 'wide', 5000, 15_000);
    expect(operator.messages.length - heard).toBeLessThanOrEqual(10);
    expect(operator.cells).toEqual(map.cells);
    const late = new Operator();
    late.hear(board, 'wide', 15_000, 16_000);
    expect(late.cells).toEqual(map.cells);
    expect(late.messages[0]).toMatchObject({ topic: '/map', number: 1, timeMs: 0, ageMs: 15_000 });
  });

  it('that changes somewhere is told there; at another place it is another map', () => {
    board.take('/map', { kind: 'map', map: mapOf(200, 100, () => 1) }, 0);
    operator.hear(board, 'wide', 0, 900);
    const before = operator.tiles;
    board.take('/map', { kind: 'map', map: mapOf(200, 100, (at) => (at === 0 ? 3 : 1)) }, 900);
    operator.hear(board, 'wide', 900, 1100);
    expect(operator.tiles - before).toBe(1);
    expect(operator.messages.at(-1)).toMatchObject({ number: 1, timeMs: 900 });
    board.take('/map', { kind: 'map', map: { ...mapOf(200, 100, () => 1), cellM: 0.1 } }, 1100);
    operator.hear(board, 'wide', 1100, 1200);
    expect(operator.messages.at(-1)).toMatchObject({ number: 2, cellM: 0.1 });
  });

  it('that cannot be placed any more is told no longer', () => {
    board.take('/map', { kind: 'map', map: mapOf(10, 10, () => 1) }, 0);
    board.take('/map', { kind: 'refused', of: 'map', reason: 'unknown-frame', frame: 'map' }, 10);
    operator.hear(board, 'wide', 10, 5000);
    expect(operator.messages).toEqual([]);
  });
});

describe('a path', () => {
  const points: [number, number][] = [
    [0, 0],
    [1, 2],
  ];

  it('is told at once, and again with its age, ever less often, until it is no news any more', () => {
    expect(board.next(operator, 'wide', 0)).toEqual([]);
    board.take('/plan', { kind: 'path', points }, 100);
    operator.hear(board, 'wide', 100, 3050);
    expect(operator.paths.map(({ ageMs }) => ageMs)).toEqual([0, 1000, 2000]);
    expect(operator.paths[0]).toEqual({ type: 'path', topic: '/plan', timeMs: 100, ageMs: 0, points });
    operator.hear(board, 'wide', 3100, 200_000);
    expect(operator.paths.length).toBeLessThan(25);
    expect(operator.paths.at(-1)?.ageMs).toBeLessThanOrEqual(60_000);
    board.take('/plan', { kind: 'path', points }, 200_000);
    operator.hear(board, 'wide', 200_000, 200_010);
    expect(operator.paths.at(-1)?.timeMs).toBe(200_000);
  });

  it('that ends, or cannot be placed any more, takes the one before it away', () => {
    const refused = { kind: 'refused', of: 'path', reason: 'unknown-frame', frame: 'map' } as const;
    board.take('/plan', refused, 0);
    expect(board.next(operator, 'wide', 0)).toEqual([]);
    board.take('/plan', { kind: 'path', points }, 100);
    operator.hear(board, 'wide', 100, 150);
    board.take('/plan', refused, 200);
    operator.hear(board, 'wide', 200, 250);
    expect(operator.paths.map((path) => path.points.length)).toEqual([2, 0]);
  });
});
