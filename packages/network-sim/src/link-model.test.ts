import fc from 'fast-check';
import { expect, test } from 'vitest';
import { CapacitySchedule, type CapacitySpec, constantCapacity } from './capacity.ts';
import { CbrFlow } from './cross-flow.ts';
import { LinkModel, type LinkModelOptions } from './link-model.ts';
import type { DropReason, LinkBin } from './link-statistics.ts';
import { burstLossOf } from './loss.ts';
import { idealProfile, type LinkProfile, ProfileError } from './profile.ts';

interface Arrival {
  handle: number;
  atMs: number;
  queueMs: number;
}

/** A model that records what was delivered. */
function link(profile: Partial<LinkProfile>, more: Partial<LinkModelOptions> = {}) {
  const arrivals: Arrival[] = [];
  const copies: number[] = [];
  const bins: LinkBin[] = [];
  const model = new LinkModel({
    profile: { ...idealProfile, ...profile },
    seed: 7,
    startMs: 0,
    sink: {
      delivered: (handle, atMs, queueMs) => arrivals.push({ handle, atMs, queueMs }),
      duplicated: (handle) => copies.push(handle),
    },
    onBin: (bin) => bins.push(bin),
    ...more,
  });
  /** Offers packets of one size at a fixed interval; returns the reasons of those dropped. */
  const offer = (count: number, bytes: number, everyMs: number, fromMs = 0): (DropReason | null)[] =>
    Array.from({ length: count }, (_, index) => model.offer(bytes, fromMs + index * everyMs, index));
  return { model, arrivals, copies, bins, offer };
}

const mbps = (rate: number) => ({ capacity: constantCapacity(rate) });

test('a backlogged link delivers exactly at its rate, a slow sender exactly after the delay', () => {
  const busy = link({ ...mbps(8), delayMs: 20 });
  busy.offer(100, 1000, 0);
  busy.model.advance(1000);
  expect(busy.arrivals.map(({ atMs }) => atMs)).toEqual(Array.from({ length: 100 }, (_, i) => i + 1 + 20));
  expect(busy.arrivals.at(-1)?.queueMs).toBe(100);

  const calm = link({ ...mbps(8), delayMs: 20 });
  calm.offer(10, 1000, 5);
  calm.model.advance(1000);
  expect(calm.arrivals.map(({ atMs }) => atMs)).toEqual(Array.from({ length: 10 }, (_, i) => 5 * i + 21));
});

test('delivers nothing before its time', () => {
  const { model, arrivals } = link({ ...mbps(8), delayMs: 20 });
  model.offer(1000, 0, 1);
  expect(model.wakeMs).toBe(21);
  model.advance(20.999);
  expect(arrivals).toEqual([]);
  model.advance(21);
  expect(arrivals).toEqual([{ handle: 1, atMs: 21, queueMs: 1 }]);
  expect(model.wakeMs).toBe(Number.POSITIVE_INFINITY);
});

test('while backlogged, the bytes that leave are the integral of the capacity', () => {
  const trace = fc.record({
    samples: fc.array(fc.constantFrom(0, 0, 0.05, 1.7, 8, 44.2, 120), { minLength: 2, maxLength: 40 }),
    loop: fc.boolean(),
    sizes: fc.array(fc.integer({ min: 29, max: 1500 }), { minLength: 20, maxLength: 300 }),
    origin: fc.double({ min: 0, max: 1e9, noNaN: true }),
  });
  fc.assert(
    fc.property(trace, ({ samples, loop, sizes, origin }) => {
      const capacity: CapacitySpec = {
        steps: samples.map((rate, index) => ({ atMs: index * 100, mbps: rate })),
        periodMs: loop ? samples.length * 100 : null,
      };
      const { model, arrivals } = link({ capacity }, { startMs: origin });
      for (const [index, bytes] of sizes.entries()) model.offer(bytes, origin, index);
      model.advance(origin + 60_000);
      const schedule = new CapacitySchedule(capacity, origin);
      let bits = 0;
      for (const [index, { atMs }] of arrivals.entries()) {
        bits += sizes[index]! * 8;
        // One microsecond at the highest capacity.
        expect(Math.abs(schedule.bitsBetween(origin, atMs) - bits)).toBeLessThan(120);
      }
      if (arrivals.length < sizes.length) {
        expect(schedule.bitsBetween(origin, origin + 60_000)).toBeLessThan(
          sizes.slice(0, arrivals.length + 1).reduce((sum, bytes) => sum + bytes * 8, 120),
        );
      }
    }),
    { seed: 3 },
  );
});

test('a queue of milliseconds never delays by more', () => {
  const { model, arrivals, offer } = link({ ...mbps(8), queue: { ms: 50 } });
  const reasons = offer(2000, 1000, 0.25);
  model.advance(2000);
  expect(Math.max(...arrivals.map(({ queueMs }) => queueMs))).toBeCloseTo(50, 6);
  expect(reasons.filter((reason) => reason === 'queue-full').length).toBe(2000 - arrivals.length);
});

test('a queue of milliseconds keeps its size through an outage, and has a size without any capacity', () => {
  const capacity = { ...constantCapacity(8), outages: [{ startMs: 10, endMs: 36_000 }] };
  const { model, arrivals, offer } = link({ capacity, queue: { ms: 100 } });
  offer(1, 1000, 0);
  const reasons = offer(200, 1000, 1, 20);
  expect(reasons.filter((reason) => reason === null).length).toBe(100);
  model.advance(40_000);
  expect(arrivals.at(-1)?.atMs).toBe(36_100);

  const dead = link({ ...mbps(0), queue: { ms: 100 } });
  expect(dead.offer(4, 1500, 0)).toEqual([null, null, 'queue-full', 'queue-full']);
  dead.model.advance(1e6);
  expect(dead.arrivals).toEqual([]);
});

test('independent loss has its rate, and each seed its own losses', () => {
  const { offer } = link({ loss: 0.05 });
  const reasons = offer(100_000, 100, 1);
  const lost = reasons.filter((reason) => reason === 'loss').length;
  // Five standard deviations.
  expect(Math.abs(lost - 5000)).toBeLessThan(5 * Math.sqrt(100_000 * 0.05 * 0.95));
  expect(link({ loss: 0.05 }).offer(1000, 100, 1)).toEqual(reasons.slice(0, 1000));
  expect(link({ loss: 0.05 }, { seed: 8 }).offer(1000, 100, 1)).not.toEqual(reasons.slice(0, 1000));
});

test('burst loss has its rate and its mean length', () => {
  const { offer } = link({ burstLoss: burstLossOf(0.04, 8) });
  const reasons = offer(200_000, 100, 1);
  const lost = reasons.filter((reason) => reason === 'burst-loss').length;
  const bursts = reasons.filter(
    (reason, i) => reason !== null && (i === 0 || reasons[i - 1] === null),
  ).length;
  expect(lost / reasons.length).toBeCloseTo(0.04, 2);
  expect(Math.abs(lost / bursts - 8)).toBeLessThan(1);
});

test('jitter in order stays within its bounds, varies, and keeps the order', () => {
  const { model, arrivals, offer } = link({ delayMs: 30, jitterMs: 10 });
  offer(5000, 1000, 0.5);
  model.advance(10_000);
  const delays = arrivals.map(({ handle, atMs }) => atMs - handle * 0.5);
  expect(Math.min(...delays)).toBeGreaterThanOrEqual(20);
  expect(Math.max(...delays)).toBeLessThanOrEqual(40 + 1e-9);
  expect(Math.max(...delays) - Math.min(...delays)).toBeGreaterThan(15);
  expect(arrivals.map(({ handle }) => handle)).toEqual(Array.from({ length: 5000 }, (_, i) => i));
});

test('jitter that reorders stays within its bounds, and never goes back in time', () => {
  const { model, arrivals, offer } = link({ delayMs: 2, jitterMs: 5, jitterReorders: true });
  offer(5000, 1000, 0.5);
  model.advance(10_000);
  const delays = arrivals.map(({ handle, atMs }) => atMs - handle * 0.5);
  expect(Math.min(...delays)).toBe(0);
  expect(Math.max(...delays)).toBeLessThanOrEqual(7);
  expect(arrivals.some(({ handle }, index) => handle !== index)).toBe(true);
  expect(arrivals.every(({ atMs }, index) => index === 0 || atMs >= arrivals[index - 1]!.atMs)).toBe(true);
});

test('an exponential tail has its mean, and keeps the order', () => {
  const { model, arrivals, offer } = link({ delayMs: 10, tailMs: 4 });
  offer(5000, 1000, 100);
  model.advance(600_000);
  const more = arrivals.map(({ handle, atMs }) => atMs - handle * 100 - 10);
  expect(Math.min(...more)).toBeGreaterThanOrEqual(0);
  expect(more.reduce((sum, ms) => sum + ms, 0) / more.length).toBeCloseTo(4, 0);
  expect(more.filter((ms) => ms > 12).length / more.length).toBeCloseTo(Math.exp(-3), 2);
  const dense = link({ tailMs: 4 });
  dense.offer(500, 1000, 0.5);
  dense.model.advance(10_000);
  expect(dense.arrivals.map(({ handle }) => handle)).toEqual(Array.from({ length: 500 }, (_, i) => i));
});

test('reordering delays its fraction of packets by its extra delay; the others keep their order', () => {
  const { model, arrivals, offer } = link({ delayMs: 10, reorder: { probability: 0.1, extraMs: 7 } });
  offer(10_000, 1000, 1);
  model.advance(20_000);
  const late = arrivals.filter(({ handle, atMs }) => atMs - handle === 17);
  expect(Math.abs(late.length - 1000)).toBeLessThan(150);
  const rest = arrivals.filter(({ handle, atMs }) => atMs - handle === 10);
  expect(late.length + rest.length).toBe(10_000);
  expect(rest.every(({ handle }, index) => index === 0 || handle > rest[index - 1]!.handle)).toBe(true);
});

test('announces a duplicated packet, and delivers it twice', () => {
  const { model, arrivals, copies, offer } = link({ duplicate: 0.2 });
  offer(1000, 100, 1);
  model.advance(2000);
  expect(copies.length).toBeGreaterThan(120);
  expect(arrivals.length).toBe(1000 + copies.length);
  const times = (handle: number) => arrivals.filter((arrival) => arrival.handle === handle).length;
  expect(copies.every((handle) => times(handle) === 2)).toBe(true);
});

test('a profile set for later takes effect then, in the middle of a packet', () => {
  const { model, arrivals } = link(mbps(8));
  model.setProfile({ ...idealProfile, ...mbps(2), delayMs: 5 }, 4);
  model.offer(8000, 0, 0);
  model.advance(1000);
  // 4000 bytes in 4 ms, 4000 more in 16 ms, 5 ms of propagation.
  expect(arrivals).toEqual([{ handle: 0, atMs: 25, queueMs: 20 }]);
});

test('a pause holds waiting packets, and a black hole drops arriving ones', () => {
  const { model, arrivals, bins } = link(mbps(8));
  model.offer(2000, 0, 0);
  model.pause(true, 1);
  model.advance(99);
  expect(arrivals).toEqual([]);
  model.pause(false, 101);
  model.blackhole(true, 101.5);
  expect(model.offer(100, 101.5, 1)).toBe('blackhole');
  model.blackhole(false, 102);
  model.advance(200);
  expect(arrivals).toEqual([{ handle: 0, atMs: 102, queueMs: 102 }]);
  expect(bins[0]?.capacityMbps).toBeCloseTo(8 * 0.01, 9);
  expect(bins[0]?.queueMsMax).toBe(100);
  expect(bins[1]?.drops.blackhole).toBe(1);
});

test('restarting begins the capacity anew', () => {
  const capacity = { ...constantCapacity(8), outages: [{ startMs: 0, endMs: 50 }] };
  const { model, arrivals } = link({ capacity });
  model.advance(60);
  model.restart(60);
  model.offer(1000, 60, 0);
  model.advance(500);
  expect(arrivals[0]?.atMs).toBe(111);
});

test('bins add up to what was offered, and report capacity and queue', () => {
  const { model, bins, offer } = link({ ...mbps(4), queue: { bytes: 20_000 }, loss: 0.1 });
  const reasons = offer(1000, 1000, 1);
  model.advance(1200);
  expect(bins.map(({ timeMs }) => timeMs)).toEqual(Array.from({ length: 12 }, (_, i) => i * 100));
  const sum = (of: (bin: LinkBin) => number) => bins.reduce((total, bin) => total + of(bin), 0);
  expect(sum((bin) => bin.offeredBytes)).toBe(1_000_000);
  expect(sum((bin) => bin.drops.loss)).toBe(reasons.filter((reason) => reason === 'loss').length);
  expect(sum((bin) => bin.drops['queue-full'])).toBe(
    reasons.filter((reason) => reason === 'queue-full').length,
  );
  expect(sum((bin) => bin.deliveredPackets)).toBe(reasons.filter((reason) => reason === null).length);
  for (const bin of bins.slice(2, 9)) {
    expect(bin.capacityMbps).toBeCloseTo(4, 9);
    expect(bin.deliveredBytes).toBe(50_000);
    expect(bin.queueMsMean).toBeGreaterThan(36);
    expect(bin.queueMsMax).toBeLessThanOrEqual(40);
  }
});

test('without a bottleneck the capacity is null', () => {
  const { model, bins } = link({});
  model.offer(1000, 3, 0);
  model.advance(100);
  expect(bins[0]?.capacityMbps).toBeNull();
  expect(bins[0]?.deliveredBytes).toBe(1000);
});

test('a constant competing flow takes its share of the queue', () => {
  const { model, bins, offer } = link(
    { ...mbps(8), queue: { bytes: 20_000 } },
    { crossFlows: [new CbrFlow(4, 0)] },
  );
  offer(8000, 1000, 0.5);
  model.advance(4000);
  const cross = bins.reduce((total, bin) => total + bin.crossBytes, 0);
  const ours = bins.reduce((total, bin) => total + bin.deliveredBytes, 0);
  expect((cross + ours) / 4_000_000).toBeGreaterThan(0.99);
  // 4 Mbit/s beside 16 Mbit/s into 8: drop-tail gives about a fifth.
  expect(cross / (cross + ours)).toBeGreaterThan(0.1);
  expect(cross / (cross + ours)).toBeLessThan(0.5);
});

test('the same seed gives the same link', () => {
  const profile = {
    ...mbps(5),
    loss: 0.1,
    jitterMs: 4,
    delayMs: 9,
    reorder: { probability: 0.1, extraMs: 3 },
  };
  const run = (seed: number) => {
    const { model, arrivals, offer } = link(profile, { seed });
    offer(500, 900, 1);
    model.advance(5000);
    return arrivals;
  };
  expect(run(1)).toEqual(run(1));
  expect(run(1)).not.toEqual(run(2));
});

test.each([
  { delayMs: -1 },
  { tailMs: Number.POSITIVE_INFINITY },
  { loss: 1.1 },
  { duplicate: Number.NaN },
  { queue: { ms: 0 } },
  { reorder: { probability: 2, extraMs: 0 } },
])('refuses an invalid profile: %j', (profile) => {
  expect(() => link(profile)).toThrow(ProfileError);
});
