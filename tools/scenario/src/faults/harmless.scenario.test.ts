/** What is nobody's reason to stop, and what stops a robot only for as long as it lasts and the hand holds on. */
import { harmlessFaults, returningFaults } from '@farpoint/robot-node/testing/faults';
import { describe, expect, test } from 'vitest';
import { runFault, runReturn, SPEED } from './run-fault.ts';
import { SEEDS } from './scenario-rig.ts';

describe.each(harmlessFaults)('$name', (fault) => {
  test('the robot goes on as fast as before', async () => {
    const { brakedAfterMs, endSpeed, fastest, log } = await runFault(fault, 1);
    expect(brakedAfterMs, log).toBe(null);
    expect([endSpeed, fastest]).toEqual([SPEED, SPEED]);
  });

  test('the robot never stands, on any link', async () => {
    for (const seed of SEEDS) {
      const { stoodAfterMs, fastest, log } = await runFault(fault, seed);
      expect(stoodAfterMs, `seed ${seed}\n${log}`).toBe(null);
      expect(fastest).toBeLessThanOrEqual(SPEED);
    }
  });
});

describe.each(returningFaults)('$name', (fault) => {
  test('the robot stays until the hand has let go', async () => {
    for (const seed of [1, ...SEEDS]) {
      const { log, ...outcome } = await runReturn(fault, seed);
      expect(outcome, `seed ${seed}\n${log}`).toEqual({
        ...{ stood: true, movedWhileWrong: 0, movedBeforeLetGo: 0 },
        drivesAgain: true,
      });
    }
  });
});
