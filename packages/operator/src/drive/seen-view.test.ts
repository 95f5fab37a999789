import { zeroTwist } from '@farpoint/protocol';
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

test('packets of an older frame count for nothing, and a new session has seen nothing', () => {
  const seen = new SeenView();
  seen.onPoints(0, 0xffff_ffff, 100, 4, 10);
  seen.onPoints(0, 0, 200, 4, 10);
  seen.onPoints(0, 0xffff_ffff, 100, 6, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(null);
  seen.onPoints(0, 0, 200, 1, 10);
  seen.onDrawn();
  expect(seen.stampUs).toBe(200);
  seen.reset();
  expect(seen.stampUs).toBe(null);
});

test('a time that is none is not taken', () => {
  const seen = new SeenView();
  for (const time of [Number.NaN, Number.POSITIVE_INFINITY, -1]) seen.onShown(time);
  expect(seen.stampUs).toBe(null);
});
