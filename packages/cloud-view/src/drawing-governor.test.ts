import { expect, test } from 'vitest';
import { DrawingGovernor, possibleFps } from './drawing-governor.ts';

function run(governor: DrawingGovernor, fps: number, fromMs: number, toMs: number): void {
  for (let now = fromMs; now < toMs; now += 250) governor.update(fps, now);
}

test('too slow for a while: coarser, then fewer points', () => {
  const governor = new DrawingGovernor();
  run(governor, 10, 0, 1500);
  expect(governor.step.scale).toBe(1);
  run(governor, 10, 1500, 2000);
  expect(governor.step.scale).toBe(0.75);
  run(governor, 10, 2000, 20_000);
  expect(governor.step).toEqual({ scale: 0.5, every: 16 });
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

test('calls a machine slow by what it cannot draw, not by what it need not', () => {
  // It waits for the frames of a robot that sends 10 a second, on a display of 60 Hz.
  expect(possibleFps(20, 60, 10)).toBe(60);
  expect(possibleFps(20, 60, 50)).toBe(20);
  // Its main thread is late, not its GPU.
  expect(possibleFps(12, 14, 5)).toBe(14);
  expect(possibleFps(60, 60, 0)).toBe(60);
  expect(possibleFps(0, 0, 0)).toBe(0);
});
