import { expect, test } from 'vitest';
import { MOST_WAITING, SLOT_MS, TraceQueue } from './trace-queue.ts';

const FRAME = { sensor: 1, frameNumber: 7, points: 600 };
const ALICE = {};
const BOB = {};

function stations(capturedAtMs: number) {
  return {
    capturedAtMs,
    inMemoryMs: capturedAtMs + 5,
    readyMs: capturedAtMs + 12,
    firstLeftMs: capturedAtMs + 13,
    lastLeftMs: capturedAtMs + 20,
  };
}

test('keeps one cloud and one command of each slot', () => {
  const queue = new TraceQueue(() => 0.5);
  for (let ms = 0; ms < 10 * SLOT_MS; ms += 10) {
    queue.cloud(ALICE, FRAME, stations(ms - 20));
    queue.command(ALICE, ms, ms, ms, ms);
  }
  const traces = queue.take(MOST_WAITING);
  expect(traces.filter(({ kind }) => kind === 'cloud')).toHaveLength(10);
  expect(traces.filter(({ kind }) => kind === 'command')).toHaveLength(10);
  expect(queue.take(1)).toEqual([]);
});

test('chooses another frame of each slot, so that no sensor is always the one', () => {
  let draws = 0;
  const queue = new TraceQueue(() => (++draws % 2) / 2);
  const at = (ms: number, sensor: number) => queue.cloud(ALICE, { ...FRAME, sensor }, stations(ms - 20));
  for (let ms = 0; ms < 10 * SLOT_MS; ms += SLOT_MS / 2) at(ms, (ms / (SLOT_MS / 2)) % 2);
  const sensors = queue.take(MOST_WAITING).map((trace) => (trace.kind === 'cloud' ? trace.sensor : -1));
  expect(new Set(sensors)).toEqual(new Set([0, 1]));
});

test('numbers sessions, and gives back what it was told', () => {
  const queue = new TraceQueue(() => 0);
  queue.cloud(ALICE, FRAME, stations(1000));
  queue.command(BOB, 3, 1000, 1001, null);
  queue.command(BOB, 4, 2000, 2001, 2002.5);
  expect(queue.take(3)).toEqual([
    { kind: 'cloud', operator: 1, sensor: 1, frame: 7, points: 600, ...stations(1000) },
    { kind: 'command', operator: 2, sequence: 3, receivedMs: 1000, judgedMs: 1001, wheelsMs: null },
    { kind: 'command', operator: 2, sequence: 4, receivedMs: 2000, judgedMs: 2001, wheelsMs: 2002.5 },
  ]);
});

test('puts no instant before the one that precedes it', () => {
  const queue = new TraceQueue(() => 0);
  queue.cloud(ALICE, FRAME, { ...stations(1000), inMemoryMs: 990 });
  expect(queue.take(1)).toMatchObject([{ capturedAtMs: 1000, inMemoryMs: 1000, readyMs: 1012 }]);
});

test('drops the oldest when too many wait, and counts their spans', () => {
  const queue = new TraceQueue(() => 0);
  queue.cloud(ALICE, FRAME, stations(0));
  queue.command(ALICE, 0, 0, 0, null);
  for (let i = 1; i < MOST_WAITING; i++) queue.command(ALICE, i, i * SLOT_MS, i * SLOT_MS, i * SLOT_MS);
  expect(queue.overwrittenSpans).toBe(4);
  queue.command(ALICE, MOST_WAITING, MOST_WAITING * SLOT_MS, MOST_WAITING * SLOT_MS, MOST_WAITING * SLOT_MS);
  expect(queue.overwrittenSpans).toBe(4 + 2);
  const left = queue.take(2 * MOST_WAITING);
  expect(left).toHaveLength(MOST_WAITING);
  expect(left[0]).toMatchObject({ sequence: 1 });
  expect(left.at(-1)).toMatchObject({ sequence: MOST_WAITING });
});
