import { expect, test } from 'vitest';
import { Battery } from './battery.ts';

test('charge only falls under load, and faster while driving', () => {
  const idle = new Battery();
  const driving = new Battery();
  let before = driving.state.percentage;
  for (let i = 0; i < 3600; i++) {
    idle.step(1, 0, 0, 0, false);
    driving.step(1, 0.8, 0.3, i % 5 === 0 ? 1 : -1, false);
    expect(driving.state.percentage).toBeLessThan(before);
    before = driving.state.percentage;
  }
  expect(driving.state.percentage).toBeLessThan(idle.state.percentage);
  expect(idle.state.percentage).toBeGreaterThan(0.8);
});

test('voltage sags under load and falls with charge', () => {
  const battery = new Battery(0.8);
  battery.step(0.001, 0, 0, 0, false);
  const resting = battery.state.voltage;
  battery.step(0.001, 1, 0, 1, false);
  expect(battery.state.voltage).toBeLessThan(resting);
  const low = new Battery(0.1);
  low.step(0.001, 0, 0, 0, false);
  expect(low.state.voltage).toBeLessThan(resting);
});

test('a dock fills it up and then stops charging', () => {
  const battery = new Battery(0.5);
  battery.step(60, 0, 0, 0, true);
  expect(battery.state.charging).toBe(true);
  expect(battery.state.percentage).toBeGreaterThan(0.5);
  for (let i = 0; i < 200; i++) battery.step(60, 0, 0, 0, true);
  expect(battery.state).toMatchObject({ percentage: 1, charging: false });
});

test('never goes below empty', () => {
  const battery = new Battery(0.001);
  for (let i = 0; i < 100; i++) battery.step(60, 1, 1, 0, false);
  expect(battery.state.percentage).toBe(0);
  expect(battery.empty).toBe(true);
});
