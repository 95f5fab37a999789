import { expect, test } from 'vitest';
import { DrawingGovernor } from './drawing-governor.ts';

function run(governor: DrawingGovernor, fps: number, fromMs: number, toMs: number, gapMs = 25): void {
  for (let now = fromMs; now < toMs; now += 250) governor.update(fps, now, gapMs);
}

test('too slow for a while: coarser, then fewer points', () => {
  const governor = new DrawingGovernor();
  run(governor, 10, 0, 1500);
  expect(governor.step.scale).toBe(1);
  run(governor, 10, 1500, 2000);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 10, 2000, 20_000);
  expect(governor.step).toEqual({ scale: 0.35, every: 16 });
});

test('a computer without a graphics processor begins coarse, and grows', () => {
  const governor = new DrawingGovernor(true);
  expect(governor.step).toEqual({ scale: 0.35, every: 16 });
  run(governor, 60, 0, 45_000);
  expect(governor.step).toEqual({ scale: 1, every: 1 });
});

test('timers that are late make it coarser, whatever the frame rate, and keep it so', () => {
  const governor = new DrawingGovernor();
  run(governor, 60, 0, 1000, 120);
  run(governor, 60, 1000, 1500);
  expect(governor.step.scale).toBe(1);
  run(governor, 60, 1500, 4000, 120);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 60, 4000, 60_000, 70);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 60, 60_000, 67_000);
  expect(governor.step.scale).toBe(1);
});

test('a short stall changes nothing', () => {
  const governor = new DrawingGovernor();
  run(governor, 10, 0, 1000);
  run(governor, 60, 1000, 2000);
  run(governor, 10, 2000, 3000);
  governor.pause();
  run(governor, 10, 3000, 4000);
  expect(governor.step.scale).toBe(1);
});

test('fast enough for long: finer again; if that was too much, not again soon', () => {
  const governor = new DrawingGovernor();
  run(governor, 10, 0, 2000);
  run(governor, 60, 2000, 9000);
  expect(governor.step.scale).toBe(1);
  run(governor, 10, 9000, 11_000);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 60, 11_000, 60_000);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 60, 60_000, 80_000);
  expect(governor.step.scale).toBe(1);
});
