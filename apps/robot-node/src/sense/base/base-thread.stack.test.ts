import type { TimedBaseState } from '@farpoint/cloud-source';
import { zeroTwist } from '@farpoint/protocol';
import { afterEach, expect, it } from 'vitest';
import { BaseThread } from './base-thread.ts';
import { SnapshotReader } from './shared-snapshot.ts';

let base: BaseThread;
afterEach(() => base.close());

const stateWhere = (is: (state: TimedBaseState) => boolean) =>
  new Promise<TimedBaseState>((resolve) => {
    base.onState = (state) => {
      if (is(state)) resolve(state);
    };
  });

it('drives on a velocity, and stops by itself when it is not refreshed', async () => {
  base = new BaseThread({ watchdogMs: 150, charge: 0.95, origin: null });
  base.apply({ ...zeroTwist(), linear: { x: 0.3, y: 0, z: 0 } });
  await stateWhere(({ twist }) => (twist?.linear.x ?? 0) > 0);
  // The velocity is not repeated, so the thread's own watchdog brakes.
  await stateWhere(({ twist }) => twist?.linear.x === 0);
  expect(base.watchdogStops).toBe(1);
});

it.each([
  [0.4, 0.3],
  [undefined, 0],
])('a base that goes sideways at %s m/s does as it is told', async (maxLateral, expected) => {
  base = new BaseThread({ watchdogMs: 1000, maxLateral, charge: 0.95, origin: null });
  base.apply({ ...zeroTwist(), linear: { x: 0.1, y: 0.3, z: 0 } });
  const { twist } = await stateWhere((state) => {
    const { x = 0, y = 0 } = state.twist?.linear ?? {};
    return x === 0.1 && y >= expected;
  });
  expect(twist?.linear).toEqual({ x: 0.1, y: expected, z: 0 });
});

it('shows its world to sensors', async () => {
  base = new BaseThread({ watchdogMs: 150, charge: 0.95, origin: null });
  const world = new SnapshotReader(base.snapshot);
  const { pose } = await stateWhere(() => true);
  const first = world.read();
  expect(first).toMatchObject({ x: pose.position.x, y: pose.position.y });
  // People walk whether the robot moves or not.
  await stateWhere(() => (world.read()?.time ?? 0) > (first?.time ?? 0) + 0.2);
  expect(world.read()?.bodies).not.toEqual(first?.bodies);
});

it('reports once that its thread has ended', async () => {
  base = new BaseThread({ watchdogMs: 150, charge: 0.95, origin: null });
  const failures: Error[] = [];
  const failed = new Promise<void>((resolve) => {
    base.onFailure = (error) => {
      failures.push(error);
      resolve();
    };
  });
  // Not a velocity: the error that it causes ends the thread.
  base.apply(null as never);
  await failed;
  await base.close();
  expect(failures.map(({ message }) => message)).toEqual([expect.stringMatching(/thread ended/)]);
});
