/** A simulated base that goes sideways, in its world. */
import { zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { SimulatedBase } from './simulated-base.ts';
import { officeWorld } from './worlds/office.ts';

/** Commands these velocities for a while. */
function driven(base: SimulatedBase, x: number, y: number, seconds: number): SimulatedBase {
  base.setCommand({ ...zeroTwist(), linear: { x, y, z: 0 } });
  for (let s = 0; s < seconds; s += 0.02) base.step(0.02);
  return base;
}

const can = () => new SimulatedBase(officeWorld(), { maxLateralSpeed: 0.5 });

test('goes to its left, without turning', () => {
  const { pose, yaw } = can().state;
  const base = driven(can(), 0, 0.2, 1);
  const { state } = base;
  const [dx, dy] = [state.pose.position.x - pose.position.x, state.pose.position.y - pose.position.y];
  expect(state.yaw).toBe(yaw);
  expect(dy * Math.cos(yaw) - dx * Math.sin(yaw)).toBeCloseTo(0.18, 2);
  expect(dx * Math.cos(yaw) + dy * Math.sin(yaw)).toBeCloseTo(0, 6);
  expect(state.twist.linear).toEqual({ x: 0, y: 0.2, z: 0 });
  expect(state.odometryDistance).toBeCloseTo(0.18, 2);
  expect(state.battery.percentage).toBeLessThan(can().state.battery.percentage);
});

test('a base that cannot stays where it is', () => {
  const base = driven(new SimulatedBase(officeWorld()), 0, 0.2, 1);
  expect(base.state.pose).toEqual(new SimulatedBase(officeWorld()).state.pose);
});

test('what stands beside it stops it, and it never ends inside anything', () => {
  const base = driven(can(), 0.2, 0.5, 20);
  expect(base.clearance).toBeGreaterThanOrEqual(-1e-9);
  const aside = driven(can(), 0, 0.5, 30);
  expect(aside.state.collision).toBe(true);
  expect(Math.abs(aside.state.twist.linear.y)).toBeLessThan(0.01);
});
