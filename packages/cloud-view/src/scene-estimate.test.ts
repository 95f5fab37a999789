import { describe, expect, test } from 'vitest';
import { SceneEstimate } from './scene-estimate.ts';

const LEVEL = { x: 0, y: 0, z: 0, w: 1 };
const SENSOR = { x: 10, y: -5, z: 0 };

/** Mulberry32. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A scene of a spinning LiDAR: ground within a radius, walls around it, and a share of wrong points below. */
function scene(groundM: number, radiusM: number, seed = 1) {
  const estimate = new SceneEstimate();
  const next = random(seed);
  for (let i = 0; i < 2048; i++) {
    const kind = next();
    const angle = 2 * Math.PI * next();
    const away = kind < 0.7 ? radiusM * Math.sqrt(next()) : radiusM;
    const noise = 0.04 * (next() - 0.5);
    const height = kind < 0.7 ? groundM + noise : kind < 0.97 ? groundM + 3 * next() : groundM - 6 * next();
    estimate.add(SENSOR, LEVEL, away * Math.cos(angle), away * Math.sin(angle), height - SENSOR.z);
  }
  return estimate;
}

const evaluated = (estimate: SceneEstimate, base = 0) => {
  estimate.update(0, SENSOR, base);
  estimate.update(600, SENSOR, base);
  return estimate;
};

describe('the ground', () => {
  test.each([1, 2, 3, 4, 5])('1.8 m below a sensor whose base does not say so, seed %i', (seed) => {
    const { ground } = evaluated(scene(-1.8, 9, seed));
    expect(ground).not.toBe(null);
    expect(Math.abs((ground as number) + 1.8)).toBeLessThan(0.1);
  });

  test('is the robot’s own where that is seen, and nothing is said', () => {
    expect(evaluated(scene(0.03, 9)).ground).toBe(null);
    expect(evaluated(scene(2, 9), 2.05).ground).toBe(null);
  });

  test('is not the robot’s own because a wall far away is seen at its height', () => {
    const estimate = new SceneEstimate();
    const next = random(3);
    for (let i = 0; i < 2048; i++) {
      const angle = 2 * Math.PI * next();
      const away = i % 3 > 0 ? 8 * Math.sqrt(next()) : 15;
      estimate.add(SENSOR, LEVEL, away * Math.cos(angle), away * Math.sin(angle), away < 15 ? -0.8 : 0.05);
    }
    expect(evaluated(estimate).ground).toBeCloseTo(-0.8);
  });

  test('is not told before two evaluations agree, and is kept while it is hidden for one', () => {
    const estimate = scene(-1.8, 9);
    estimate.update(0, SENSOR, 0);
    expect(estimate.ground).toBe(null);
    estimate.update(400, SENSOR, 0);
    expect(estimate.ground).toBe(null);
    estimate.update(600, SENSOR, 0);
    expect(estimate.ground).toBeCloseTo(-1.8, 1);
    // A wall right before the sensor: three cells.
    for (let i = 0; i < 2048; i++) estimate.add(SENSOR, LEVEL, 0.5, (i % 300) / 100, i / 700);
    estimate.update(1200, SENSOR, 0);
    expect(estimate.ground).toBeCloseTo(-1.8, 1);
    estimate.update(1800, SENSOR, 0);
    expect(estimate.ground).toBe(null);
  });

  test('is none where heights are all over the place', () => {
    const estimate = new SceneEstimate();
    const next = random(7);
    for (let i = 0; i < 2048; i++) {
      const [x, y] = [16 * next() - 8, 16 * next() - 8];
      // Each square metre has its own lowest height.
      const low = (Math.abs(Math.floor(x) * 7 + Math.floor(y) * 13) % 40) / 4 + 1;
      estimate.add(SENSOR, LEVEL, x, y, low + next());
    }
    expect(evaluated(estimate).ground).toBe(null);
  });

  test('follows the sensor’s orientation', () => {
    const estimate = new SceneEstimate();
    // An optical frame that looks ahead: its y axis points down.
    const ahead = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };
    for (let i = 0; i < 2048; i++) {
      estimate.add({ x: 0, y: 0, z: 0.5 }, ahead, (i % 32) / 4 - 4, 1.5, 1 + (i >> 5) / 10);
    }
    estimate.update(0, { x: 0, y: 0 }, 0);
    estimate.update(600, { x: 0, y: 0 }, 0);
    expect(estimate.ground).toBeCloseTo(-1, 2);
    expect(estimate.extent).toBeGreaterThan(6);
    expect(estimate.extent).toBeLessThan(8.5);
  });
});

describe('the extent', () => {
  test('leaves a few far points out', () => {
    const estimate = scene(-1.8, 20);
    for (let i = 0; i < 60; i++) estimate.add(SENSOR, LEVEL, 150, i, 0);
    expect(evaluated(estimate).extent).toBeCloseTo(20, 0);
  });

  test('is not known from a few samples, nor after a reset', () => {
    const estimate = new SceneEstimate();
    for (let i = 0; i < 100; i++) estimate.add(SENSOR, LEVEL, i, 0, 0);
    expect(evaluated(estimate).extent).toBe(null);
    const full = evaluated(scene(-1.8, 9));
    full.reset();
    expect([full.ground, full.extent]).toEqual([null, null]);
  });
});
