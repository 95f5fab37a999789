import { zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { SeenView } from './seen-view.ts';

const command = {
  type: 'command',
  sequence: 1,
  timeMs: 0,
  lease: 'lease',
  deadMan: true,
  twist: zeroTwist(),
} as const;

test('nothing is seen until half of a cloud has been drawn', () => {
  const seen = new SeenView();
  expect(seen.stamp(command)).toBe(command);
  seen.onPoints(0, 7, 1000, 499, 1000);
  seen.onDrawn();
  expect(seen.stampUs).toBe(null);
  seen.onPoints(0, 7, 1000, 1, 1000);
  expect(seen.stampUs).toBe(null);
  seen.onDrawn();
  expect(seen.stampUs).toBe(1000);
  expect(seen.stamp(command)).toEqual({ ...command, seenUs: 1000 });
});

test('the newest of all sensors and pictures counts, across the wrap of the clock', () => {
  const seen = new SeenView();
  seen.onPoints(0, 1, 0xffff_ff00, 10, 10);
  seen.onPoints(1, 1, 0xffff_fe00, 10, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(0xffff_ff00);
  seen.onPoints(1, 2, 0x10, 10, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(0x10);
  seen.onShown(2 ** 32 / 1000 + 0.008);
  expect(seen.stampUs).toBe(0x10);
  seen.onShown(2 ** 32 / 1000 + 5);
  expect(seen.stampUs).toBe(5000);
});

test('of clouds that come in part, the older of those that make up half a cloud counts', () => {
  const seen = new SeenView();
  // A slow computer gets a fifth of every cloud.
  for (let frame = 0; frame < 100; frame++) {
    seen.onPoints(0, frame, frame * 1000, 20, 100);
    seen.onDrawn();
    expect(seen.stampUs).toBe(frame < 2 ? null : (frame - 2) * 1000);
  }
  // One that comes whole counts at once.
  seen.onPoints(0, 100, 100_000, 60, 100);
  seen.onDrawn();
  expect(seen.stampUs).toBe(100_000);
});

test('late packets count for their frame, across the wrap of the numbers, until it is forgotten', () => {
  const seen = new SeenView();
  seen.onPoints(0, 0xffff_ffff, 100, 4, 10);
  seen.onPoints(0, 0, 200, 4, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(100);
  seen.onPoints(0, 0, 200, 1, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(200);
  for (let frame = 10; frame < 20; frame++) seen.onPoints(0, frame, frame * 100, 0, 10);
  seen.onPoints(0, 0, 5000, 10, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(200);
  seen.reset();
  expect(seen.stampUs).toBe(null);
});

test('whatever comes in whatever order: half a cloud at least is as new as what counts', () => {
  const packets = fc.array(
    fc.record({ frame: fc.nat(30), share: fc.integer({ min: 0, max: 60 }), draws: fc.boolean() }),
    { maxLength: 120 },
  );
  fc.assert(
    fc.property(packets, (all) => {
      const seen = new SeenView();
      const shares = new Map<number, number>();
      let before: number | null = null;
      for (const { frame, share, draws } of all) {
        seen.onPoints(0, frame, frame, share, 100);
        shares.set(frame, Math.min(100, (shares.get(frame) ?? 0) + share));
        if (draws) seen.onDrawn();
        const { stampUs } = seen;
        if (stampUs === null) continue;
        expect(stampUs).toBeGreaterThanOrEqual(before ?? 0);
        before = stampUs;
        const asNew = [...shares].filter(([number]) => number >= stampUs);
        expect(asNew.reduce((sum, [, points]) => sum + points, 0)).toBeGreaterThanOrEqual(50);
      }
    }),
    { seed: 19 },
  );
});

test('a cloud without points shows nothing', () => {
  const seen = new SeenView();
  seen.onPoints(0, 1, 100, 0, 0);
  seen.onDrawn();
  expect(seen.stampUs).toBe(null);
  seen.onPoints(0, 2, 200, 10, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(200);
});

test('a time that is none is not taken', () => {
  const seen = new SeenView();
  for (const time of [Number.NaN, Number.POSITIVE_INFINITY, -1]) seen.onShown(time);
  expect(seen.stampUs).toBe(null);
});
