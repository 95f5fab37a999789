import type { SourceDescription } from '@farpoint/cloud-source';
import { MAX_ALARMS, MAX_QUANTITIES, type Quantity } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { expect, it } from 'vitest';
import { openBoard } from './open-board.ts';

it('leaves out recorded quantities and alarms that have no room beside the robot’s own, and says so', () => {
  const quantities = Array.from(
    { length: 60 },
    (_, number): Quantity => ({
      type: 'quantity',
      number,
      topic: `/${number}`,
      field: '',
      label: 'x',
      unit: '',
    }),
  );
  const rules = Array.from({ length: 30 }, () => ({
    ...{ watches: 'speed', label: 'Speed', unit: 'm/s', hysteresis: 0, high: { warn: 1 } },
  }));
  const telemetry = {
    quantities: Array.from({ length: 10 }, () => ({ topic: '/t', field: 'f', label: 'l', unit: '' })),
    alarms: Array.from({ length: 3 }, () => ({ watches: 'charge', label: 'Battery' })),
  };
  const warned: unknown[] = [];
  const log = { warn: (facts: unknown) => warned.push(facts) } as unknown as Logger;
  const announced: [quantities: number, alarms: number][] = [];
  const board = openBoard(
    { quantities, alarms: rules },
    { description: { telemetry } as unknown as SourceDescription, onTelemetry: null },
    {
      telemetryTaker: (all, alarms) => {
        announced.push([all.length, alarms.length]);
        return { sample: () => {}, alarm: () => {}, diagnostics: () => {} };
      },
    },
    log,
  );
  expect(board.quantities).toHaveLength(MAX_QUANTITIES);
  expect(announced).toEqual([[MAX_QUANTITIES, MAX_ALARMS]]);
  expect(warned).toEqual([{ left: { quantities: 6, alarms: 1 } }]);
});
