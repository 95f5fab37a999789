/** What goes wrong while a robot is driven with the grip held: with the limits that ship, exact to the millisecond. */
import { BRAKES_MS, brakingFaults } from '@farpoint/robot-node/testing/faults';
import { describe, expect, test } from 'vitest';
import { BRAKES_AFTER_MS } from './braking-times.ts';
import { longestWayMs, runFault, SPEED } from './run-fault.ts';
import { SEEDS } from './scenario-rig.ts';

/** As its wheels are told: without a command for so long the robot stands. */
const WATCHDOG_MS = 150;

describe.each(brakingFaults)('$name', (fault) => {
  test('brakes after so many milliseconds, and stays', async () => {
    const outcome = await runFault(fault, 1);
    expect(outcome.brakedAfterMs, outcome.log).toBe(BRAKES_AFTER_MS[fault.name]);
    expect(outcome.endSpeed).toBe(0);
  });

  test('brakes in time on any link, and stays', async () => {
    for (const seed of SEEDS) {
      const { brakedAfterMs, validAfterMs, movedAgain, endSpeed, fastest, log } = await runFault(fault, seed);
      const told = `seed ${seed}, braked after ${brakedAfterMs} ms\n${log}`;
      expect(brakedAfterMs, told).not.toBe(null);
      const most = (fault.withinMs ?? BRAKES_MS) + longestWayMs(seed);
      expect(brakedAfterMs, told).toBeLessThanOrEqual(most);
      // No command moves it for longer than the watchdog's time, whatever happens to the link.
      if (validAfterMs > 0) expect(brakedAfterMs, told).toBeLessThanOrEqual(Math.ceil(validAfterMs));
      expect(validAfterMs, told).toBeLessThanOrEqual(Math.max(brakedAfterMs ?? 0, 0) + WATCHDOG_MS);
      expect([movedAgain, endSpeed], told).toEqual([0, 0]);
      expect(fastest, told).toBeLessThanOrEqual(SPEED);
    }
  });
});
