import { expect, test } from 'vitest';
import { constantCapacity } from './capacity.ts';
import { EventQueue } from './event-queue.ts';
import type { DropReason } from './link-statistics.ts';
import { PacketLoss } from './loss.ts';
import { Path, type PathOptions } from './path.ts';
import { idealProfile, type LinkProfile } from './profile.ts';
import { Random } from './random.ts';
import { runFlow } from './run-flow.ts';
import { Stalls } from './stalls.ts';
import { TcpFlow } from './tcp-flow.ts';
import { VirtualLink, type VirtualLinkOptions } from './virtual-link.ts';

interface Arrival {
  packet: number;
  atMs: number;
  queueMs: number;
}

const profile: LinkProfile = { ...idealProfile, capacity: constantCapacity(8), delayMs: 20 };

function setUp(options: Partial<PathOptions & VirtualLinkOptions> = {}) {
  const events = new EventQueue();
  const link = new VirtualLink(events, { profile, seed: 1, ...options });
  const path = new Path(events, { link, ...options });
  const arrivals: Arrival[] = [];
  const drops: [packet: number, reason: DropReason][] = [];
  /** Sends packets of 1000 bytes at these times. */
  const send = (...timesMs: number[]) => {
    for (const [packet, timeMs] of timesMs.entries()) {
      events.at(timeMs, () =>
        path.send(1000, {
          delivered: (atMs, queueMs) => arrivals.push({ packet, atMs, queueMs }),
          dropped: (reason) => drops.push([packet, reason]),
        }),
      );
    }
  };
  return { events, link, path, arrivals, drops, send };
}

test('a packet waits for the bottleneck, then takes the link’s delay and the path’s own', () => {
  const { events, arrivals, send } = setUp({ moreDelayMs: 7 });
  send(0, 0, 10);
  events.runUntil(27.9);
  expect(arrivals).toEqual([]);
  events.runUntil(1000);
  expect(arrivals).toEqual([
    { packet: 0, atMs: 28, queueMs: 1 },
    { packet: 1, atMs: 29, queueMs: 2 },
    { packet: 2, atMs: 38, queueMs: 1 },
  ]);
});

test('distinguishes a full queue from a loss behind the link', () => {
  const loss = { process: new PacketLoss(1), model: { loss: 1, burstLoss: null } };
  const { events, link, arrivals, drops, send } = setUp({
    profile: { ...profile, queue: { bytes: 2000 } },
    loss,
  });
  send(0, 0, 0);
  events.runUntil(0.5);
  expect(drops).toEqual([[2, 'queue-full']]);
  // Packets lost behind the link have used their share of the capacity.
  expect(link.model.backlogBytes).toBe(2000);
  events.runUntil(100);
  expect(drops.slice(1)).toEqual([
    [0, 'loss'],
    [1, 'loss'],
  ]);
  expect(arrivals).toEqual([]);
});

/** A process that stalls from 10 to 30 ms. */
class OneStall extends Stalls {
  constructor() {
    super({ perSecond: 1, lengthMs: [20, 20] }, new Random(1, 0));
  }
  override after(atMs: number): number {
    return atMs >= 10 && atMs < 30 ? 30 : atMs;
  }
}

test('a stalled link accepts and delivers packets after the stall', () => {
  const { events, arrivals, send } = setUp({ stalls: new OneStall() });
  send(8.5, 9.5, 12);
  events.runUntil(100);
  expect(arrivals).toEqual([
    { packet: 0, atMs: 29.5, queueMs: 1 },
    { packet: 1, atMs: 50, queueMs: 20.5 },
    { packet: 2, atMs: 51, queueMs: 19 },
  ]);
});

test('packets held back by a stall arrive in order', () => {
  const stalls = new Stalls({ perSecond: 4, lengthMs: [5, 25] }, new Random(1, 0));
  const delayed = { ...profile, capacity: constantCapacity(23), delayMs: 21.2 };
  const { events, arrivals, send } = setUp({ profile: delayed, stalls });
  send(...Array.from({ length: 5000 }, (_, packet) => packet * 0.33));
  events.runUntil(10_000);
  expect(arrivals.map(({ packet }) => packet)).toEqual(Array.from({ length: 5000 }, (_, packet) => packet));
});

test('a stalled receiver records arrivals at the end of the stall', () => {
  const { events, arrivals, send } = setUp({
    profile: { ...profile, delayMs: 0 },
    receiverStalls: new OneStall(),
  });
  send(0, 10, 20);
  events.runUntil(100);
  expect(arrivals.map(({ atMs }) => atMs)).toEqual([1, 30, 30]);
});

test('flows on paths over one link share it, and each hears of its own packets', () => {
  const events = new EventQueue();
  const link = new VirtualLink(events, { profile: { ...profile, queue: { ms: 100 } }, seed: 1 });
  const flows = [0, 0].map((startMs) => {
    const totals = { sent: 0, delivered: 0, dropped: 0 };
    const flow = new TcpFlow({ congestionControl: 'cubic', startMs, ackDelayMs: 20, bytes: 3_000_000 });
    runFlow(events, flow, new Path(events, { link }), {
      sent: (bytes) => {
        totals.sent += bytes;
      },
      delivered: (bytes) => {
        totals.delivered += bytes;
      },
      dropped: () => {
        totals.dropped += 1500;
      },
    });
    return totals;
  });
  events.runUntil(5900);
  // 6 MB need 6 s at 8 Mbit/s.
  const both = flows.reduce((sum, { delivered }) => sum + delivered, 0);
  expect(both).toBeGreaterThan(5_500_000);
  expect(both).toBeLessThanOrEqual(5_900_000);
  events.runUntil(60_000);
  for (const { sent, delivered, dropped } of flows) {
    expect(delivered).toBeGreaterThanOrEqual(3_000_000);
    expect(sent).toBe(delivered + dropped);
  }
});

test('a packet that the link duplicates arrives twice, and others once', () => {
  const { events, arrivals, send } = setUp({ profile: { ...profile, duplicate: 0.5 } });
  send(...Array.from({ length: 20 }, (_, i) => 10 * i));
  events.runUntil(1000);
  const counts = Array.from({ length: 20 }, (_, i) => arrivals.filter(({ packet }) => packet === i).length);
  expect(new Set(counts)).toEqual(new Set([1, 2]));
});
