import { brakingFaults, harmlessFaults } from '@farpoint/robot-node/testing/faults';
import { expect, test } from 'vitest';
import { runFault } from './run-fault.ts';

test.each([...brakingFaults, ...harmlessFaults])('$name: the same run, byte for byte', async (fault) => {
  const first = await runFault(fault, 5);
  const second = await runFault(fault, 5);
  expect(second.log).toBe(first.log);
  expect(second).toEqual(first);
});
