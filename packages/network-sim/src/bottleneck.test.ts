import { expect, test } from 'vitest';
import { Bottleneck } from './bottleneck.ts';
import type { CapacityStep } from './capacity.ts';
import type { QueuedPacket } from './packet-queue.ts';
import type { QueueLimit } from './profile.ts';

function link(queue: QueueLimit, ...steps: CapacityStep[]) {
  const bottleneck = new Bottleneck({ steps, periodMs: null }, queue, 0);
  const packet: QueuedPacket = { timeMs: 0, bytes: 0, owner: 0, handle: 0, queueMs: 0 };
  /** Serves until a time. @returns when each packet left */
  const departures = (untilMs: number): number[] => {
    const times: number[] = [];
    while (bottleneck.nextMs <= untilMs) {
      const atMs = bottleneck.nextMs;
      if (bottleneck.serve(packet)) times.push(atMs);
    }
    return times;
  };
  return { bottleneck, departures };
}

const plenty = { bytes: 1e6 };

test('packets leave one after the other at the link’s rate', () => {
  const { bottleneck, departures } = link(plenty, { atMs: 0, mbps: 8 });
  bottleneck.admit(0, 1000, 0, 0);
  bottleneck.admit(0, 1000, 0, 1);
  expect(departures(9)).toEqual([1, 2]);
  expect(bottleneck.nextMs).toBe(Number.POSITIVE_INFINITY);
  bottleneck.admit(10, 1000, 0, 2);
  expect(departures(100)).toEqual([11]);
});

test('a packet continues at the new rate if the capacity changes during it', () => {
  const leaves = (bytes: number, ...steps: CapacityStep[]) => {
    const { bottleneck, departures } = link(plenty, ...steps);
    bottleneck.admit(0, bytes, 0, 0);
    return departures(1e6);
  };
  expect(leaves(2000, { atMs: 0, mbps: 8 }, { atMs: 1, mbps: 4 })).toEqual([3]);
  expect(leaves(1000, { atMs: 0, mbps: 0 }, { atMs: 500, mbps: 8 })).toEqual([501]);
  expect(leaves(1000, { atMs: 0, mbps: 0 })).toEqual([]);
});

test('refuses packets while the queue is full, until something has left', () => {
  const { bottleneck, departures } = link({ bytes: 2000 }, { atMs: 0, mbps: 8 });
  expect([0, 1, 2].map((handle) => bottleneck.admit(0, 1000, 0, handle))).toEqual([true, true, false]);
  expect(departures(1)).toEqual([1]);
  expect(bottleneck.admit(1, 1000, 0, 3)).toBe(true);
  expect(bottleneck.backlogBytes).toBe(2000);
  expect(departures(100)).toEqual([2, 3]);
});

test('a change and a pause take effect in the middle of a packet, and in what the link could carry', () => {
  const { bottleneck, departures } = link(plenty, { atMs: 0, mbps: 8 });
  bottleneck.admit(0, 4000, 0, 0);
  bottleneck.change({ steps: [{ atMs: 0, mbps: 16 }], periodMs: null }, plenty, 0, 1);
  bottleneck.pause(true, 2);
  expect(departures(50)).toEqual([]);
  bottleneck.pause(false, 50);
  // 1000 bytes in the first ms, 2000 in the second, the rest after the pause.
  expect(departures(100)).toEqual([50.5]);
  expect(bottleneck.takeCapacityBits(60)).toBe(8000 + 16_000 + 160_000);
});
