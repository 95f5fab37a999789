import { expect, it } from 'vitest';
import { excessiveStrain, MAX_GROWTH_BYTES, type Reading, strainOf, strainText } from './strain.ts';

const MB = 2 ** 20;

function reading(atMs: number, processorMs: number, gapMs = 26, bytes = 300 * MB): Reading {
  return { atMs, processorMs, gapMs, bytes };
}

/** 200 ms of each second are used before; then 1,000 packets arrive in half a second. */
function strain(processorMs: number, gapMs = 26, bytes = 300 * MB) {
  const readings = {
    first: reading(0, 1000),
    idle: [reading(1000, 1400), reading(2000, 1600)] as const,
    last: reading(2500, 1600 + processorMs, gapMs, bytes),
  };
  return strainOf(readings, 1000);
}

it('counts processor time beyond what is used anyway, for each packet', () => {
  expect(strain(150).processorUs).toBeCloseTo(50);
  expect(strain(80).processorUs).toBe(0);
  expect(strainText(strain(150))).toBe('1000 packets, 50 µs each, pause 26 ms, 0 MB');
});

it('judges pauses, processor time and memory', () => {
  expect(excessiveStrain(strain(590, 150, 300 * MB + MAX_GROWTH_BYTES))).toBeNull();
  expect(excessiveStrain(strain(100, 151))).toBe('the robot paused for 151 ms');
  expect(excessiveStrain(strain(610))).toBe('a packet took 510 µs of the robot');
  expect(excessiveStrain(strain(100, 26, 351 * MB))).toBe('the robot has grown by 51 MB');
});
