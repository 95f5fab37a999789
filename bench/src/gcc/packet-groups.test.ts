import { expect, test } from 'vitest';
import { PacketGroups } from './packet-groups.ts';

/** Adds packets. @returns the deltas, sent and arrival, of each complete group */
function deltas(packets: readonly (readonly [sentMs: number, arrivalMs: number])[]): number[][] {
  const groups = new PacketGroups();
  const out: number[][] = [];
  for (const [sent, arrival] of packets)
    if (groups.add(sent, arrival)) out.push([groups.sentDeltaMs, groups.arrivalDeltaMs]);
  return out;
}

test('packets within 5 ms form a group; groups are compared by their last packets', () => {
  const packets = [0, 2, 5, 10, 12, 20, 30].map((sent) => [sent, 100 + 1.5 * sent] as const);
  expect(deltas(packets)).toEqual([
    [7, 10.5],
    [8, 12],
  ]);
});

test('packets that a path holds back and releases at once join the group', () => {
  // Sent every 6 ms; the second to fourth were held back.
  const arrivals = [100, 140, 140.5, 141, 147, 153];
  const packets = arrivals.map((arrival, i) => [6 * i, arrival] as const);
  expect(deltas(packets)).toEqual([
    [18, 41],
    [6, 6],
  ]);
});

test('a held-back group lasts no longer than 100 ms', () => {
  const held = Array.from({ length: 60 }, (_, i) => [6 * i, 100 + 4 * i] as const);
  expect(deltas(held).map(([sent]) => sent)).toEqual([150]);
});

test('ignores a packet that was overtaken by a later group', () => {
  const packets = [
    [0, 100],
    [10, 110],
    [20, 120],
    [11, 121],
    [30, 130],
  ] as const;
  expect(deltas(packets)).toEqual([
    [10, 10],
    [10, 10],
  ]);
});

test('starts again after a reset', () => {
  const groups = new PacketGroups();
  expect([0, 10, 20].map((ms) => groups.add(ms, ms))).toEqual([false, false, true]);
  groups.reset();
  expect([100, 110, 120].map((ms) => groups.add(ms, ms + 50))).toEqual([false, false, true]);
  expect(groups.arrivalDeltaMs).toBe(10);
});
