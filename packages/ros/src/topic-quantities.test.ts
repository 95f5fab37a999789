import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { numbersOf, quantitiesOf } from './topic-quantities.ts';
import { topicTableSchema } from './topic-table.ts';

const entryOf = (given: object) => topicTableSchema.parse([given])[0]!;
const header = { stamp: { sec: 1, nanosec: 2 }, frame_id: '' };

describe('quantities of a topic', () => {
  it('are those that the table names, with the topic’s label if there is one only', () => {
    const entry = entryOf({
      ...{ topic: '/gripper', type: 'a/msg/B', as: 'text', label: 'Gripper' },
      quantities: [{ unit: '°C' }],
    });
    expect(quantitiesOf(entry)).toEqual([{ field: 'data', label: 'Gripper', unit: '°C' }]);
    expect(numbersOf(entry, { data: 21.5 })).toEqual([21.5]);
    expect(numbersOf(entry, { data: Number.NaN })).toEqual([null]);
    expect(numbersOf(entry, { data: '21.5' })).toEqual([null]);
  });

  it('are found in nested messages and arrays', () => {
    const entry = entryOf({
      ...{ topic: '/arm', type: 'a/msg/B', as: 'text' },
      quantities: [{ field: 'motor.current' }, { field: 'cells[1]' }, { field: 'ok' }, { field: 'toString' }],
    });
    expect(quantitiesOf(entry).map(({ label }) => label)).toEqual([
      'motor.current',
      'cells[1]',
      'ok',
      'toString',
    ]);
    const message = { motor: { current: 3n }, cells: Float32Array.of(4, 4.5), ok: true };
    expect(numbersOf(entry, message)).toEqual([3, 4.5, 1, null]);
  });

  it('of a battery and a position follow from the message', () => {
    const battery = entryOf({ topic: '/battery', as: 'battery' });
    expect(numbersOf(battery, { voltage: 25.1, percentage: 0.5, current: -2 })).toEqual([50, 25.1, -2]);
    expect(numbersOf(battery, { voltage: Number.NaN, percentage: -1 })).toEqual([null, null, null]);
    const fix = entryOf({ topic: '/fix', as: 'fix' });
    const message = {
      header,
      status: { status: 0, service: 1 },
      ...{ latitude: 48.1, longitude: 11.5, altitude: Number.NaN },
      ...{ position_covariance: new Float64Array(9), position_covariance_type: 0 },
    };
    expect(numbersOf(fix, message)).toEqual([48.1, 11.5, null]);
    expect(numbersOf(fix, { ...message, status: { status: -1, service: 1 } })).toEqual([null, null, null]);
  });

  it('are refused where they cannot be read, and where there are too many', () => {
    const text = { topic: '/t', type: 'a/msg/B', as: 'text' };
    const refused = (entries: object[]) => topicTableSchema.safeParse(entries).error?.issues[0]?.message;
    expect(refused([{ topic: '/battery', as: 'battery', quantities: [{}] }])).toContain('as: text only');
    expect(refused([{ ...text, quantities: [{ field: 'a b' }] }])).toContain('must be a field');
    const many = Array.from({ length: 9 }, (_, i) => ({
      ...text,
      topic: `/t${i}`,
      quantities: Array.from({ length: 8 }, () => ({})),
    }));
    expect(refused(many)).toContain('64 quantities');
  });

  it('are finite numbers or nothing, whatever the message', () => {
    const entry = entryOf({
      ...{ topic: '/t', type: 'a/msg/B', as: 'text' },
      quantities: [{ field: 'a' }, { field: 'a.b[0]' }, { field: '__proto__.c' }],
    });
    fc.assert(
      fc.property(fc.anything({ withBigInt: true, withTypedArray: true, maxDepth: 4 }), (message) => {
        const numbers = numbersOf(entry, message);
        expect(numbers).toHaveLength(3);
        for (const number of numbers) expect(number === null || Number.isFinite(number)).toBe(true);
      }),
    );
  });
});
