import { zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { BlindTravel, blindSpeedMps } from './blind-travel.ts';
import { OperatorView } from './operator-view.ts';
import { ViewAge } from './view-age.ts';

/** Longer than any time between two commands here: pauses are OperatorView's. */
const PAUSE_MS = 10_000;
const limits = { slowMs: 250, brakeMs: 400, stallMs: 150 };
const forward = { ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } };

test('motion needs a picture: full speed while it is fresh, slower when it is late, none when it is too old', () => {
  const view = new OperatorView(PAUSE_MS);
  const guard = new ViewAge(view, limits);
  expect(guard.bound(forward, 0)).toEqual({ factor: 0, reason: 'view-unknown', urgent: true });
  view.note(100, 0);
  expect(guard.bound(forward, 150).reason).toBe(null);
  expect(guard.bound(forward, 225)).toEqual({ factor: 0.5, reason: 'view-late', urgent: false });
  expect(guard.bound(forward, 299).factor).toBeCloseTo(1 / 150);
  expect(guard.bound(forward, 300)).toEqual({ factor: 0, reason: 'view-lost', urgent: true });
});

test('pictures that no longer come are noticed before they are old', () => {
  const view = new OperatorView(PAUSE_MS);
  const guard = new ViewAge(view, limits);
  for (let t = 0; t <= 3000; t += 30) view.note(20, t);
  expect(guard.bound(forward, 3000 + 30 + 150).reason).toBe(null);
  expect(guard.bound(forward, 3000 + 30 + 151).reason).toBe('view-late');
  expect(guard.bound(forward, 3000 + 30 + 225)).toMatchObject({ factor: 0.5 });
  expect(guard.bound(forward, 3000 + 30 + 300)).toEqual({ factor: 0, reason: 'view-lost', urgent: true });
});

test('after a late picture the robot is slower for a moment, not stopped', () => {
  const view = new OperatorView(PAUSE_MS);
  const guard = new ViewAge(view, limits);
  view.note(100, -50);
  view.note(100, 0);
  view.note(100, 290);
  expect(guard.bound(forward, 290)).toMatchObject({ factor: 0.25, reason: 'view-late' });
  for (let t = 300; t < 1500; t += 50) view.note(100, t);
  expect(guard.bound(forward, 1500).reason).toBe(null);
});

test('the way while blind and the way to brake stay within the length', () => {
  const travel = { mostM: 0.5, decelerationMps2: 2, radiusM: 0.25 };
  expect(blindSpeedMps(250, travel)).toBeCloseTo(1);
  for (const ageMs of [0, 40, 120, 250, 900, 3000]) {
    const v = blindSpeedMps(ageMs, travel);
    expect((v * ageMs) / 1000 + (v * v) / 4).toBeCloseTo(0.5);
  }
  const view = new OperatorView(PAUSE_MS);
  const guard = new BlindTravel(view, travel);
  expect(guard.bound(forward, 0).reason).toBe(null);
  view.note(500, 0);
  const { factor, reason } = guard.bound(forward, 0);
  expect([reason, factor]).toEqual(['blind-travel', blindSpeedMps(500, travel)]);
  // A turn moves the robot's edge.
  const turning = { ...forward, angular: { x: 0, y: 0, z: 4 } };
  expect(guard.bound(turning, 0).factor).toBeCloseTo(factor / 2);
});

test('a way to the side while blind counts as one ahead, and a slanting one as the whole of it', () => {
  const view = new OperatorView(150);
  view.note(400, 1000);
  const blind = new BlindTravel(view, { mostM: 0.5, decelerationMps2: 2, radiusM: 0.25 });
  const share = (x: number, y: number) =>
    blind.bound({ ...zeroTwist(), linear: { x, y, z: 0 } }, 1000).factor;
  expect(share(1, 0)).toBeLessThan(1);
  expect(share(0, -1)).toBe(share(1, 0));
  expect(share(0.6, 0.8)).toBeCloseTo(share(1, 0));
  expect(share(0.6, 0.8)).toBeLessThan(share(0.6, 0));
});
