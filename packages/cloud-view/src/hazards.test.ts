import { expect, test } from 'vitest';
import { type Hazards, hazardUniforms, setHazards } from './hazards.ts';
import { PointColouring } from './point-colouring.ts';
import { createPointMaterial } from './point-material.ts';

const LEVEL: Hazards = {
  ...{ position: { x: 3, y: -2, z: 0.1 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
  ...{ clearanceM: 0.04, heightM: 1.1, dropM: 0.15, slope: 0.01, ownM: 0.2 },
};

test('heights count from the base, along its z axis', () => {
  const uniforms = hazardUniforms();
  setHazards(uniforms, LEVEL);
  expect(uniforms.hazardBase.value.toArray()).toEqual([3, -2, 0.1, 0.2]);
  expect(uniforms.hazardUp.value.toArray()).toEqual([0, 0, 1]);
  expect(uniforms.hazardBand.value.toArray()).toEqual([0.04, 1.1, 0.15, 0.01]);
  // On a ramp of 10° that rises ahead, x ahead: the nose is up, so the z axis leans back.
  const half = (-10 / 2) * (Math.PI / 180);
  setHazards(uniforms, { ...LEVEL, orientation: { x: 0, y: Math.sin(half), z: 0, w: Math.cos(half) } });
  const { x, y, z } = uniforms.hazardUp.value;
  expect(x).toBeCloseTo(-Math.sin(Math.PI / 18));
  expect(y).toBeCloseTo(0);
  expect(z).toBeCloseTo(Math.cos(Math.PI / 18));
});

test('nothing is tinted before anybody says what, and afterwards', () => {
  const { uniforms } = createPointMaterial();
  const colouring = new PointColouring(uniforms);
  colouring.update(0);
  expect(uniforms.hazardBand.value.y).toBe(0);
  colouring.hazards = LEVEL;
  colouring.update(1);
  expect(uniforms.hazardBand.value.y).toBe(1.1);
  colouring.hazards = null;
  colouring.update(2);
  expect(uniforms.hazardBand.value.y).toBe(0);
});
