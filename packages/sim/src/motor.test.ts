import { expect, test } from 'vitest';
import { Motor } from './motor.ts';

function after(seconds: number, speed: number, acceleration: number, motor = new Motor()): Motor {
  for (let t = 0; t < seconds; t += 0.1) motor.step(0.1, speed, acceleration);
  return motor;
}

test('driving warms a motor, standing cools it again', () => {
  const warm = after(600, 0.8, 0).celsius;
  expect(warm).toBeGreaterThan(24);
  expect(warm).toBeLessThan(40);
  expect(after(600, 0.8, 1).celsius).toBeGreaterThan(60);
  const motor = after(600, 0.8, 1);
  expect(after(1200, 0, 0, motor).celsius).toBeLessThan(24);
});
