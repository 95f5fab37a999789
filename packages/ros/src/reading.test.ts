import { longProperty } from '@farpoint/network-sim/cases';
import { readingSchema } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readingOf } from './reading.ts';
import type { TopicEntry, TopicRole } from './topic-table.ts';

/** Any code points. `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc
  .array(fc.nat(0x10ffff), { maxLength: 500 })
  .map((codes) => String.fromCodePoint(...codes).toWellFormed());

const entry = (as: TopicRole, label?: string): TopicEntry => ({
  topic: '/t',
  type: 'a/msg/B',
  as,
  most: 1,
  label,
});
const header = { stamp: { sec: 1, nanosec: 2 }, frame_id: 'base_link' };
const texts = (as: TopicRole, message: unknown) =>
  readingOf(entry(as), message).values.map(([name, value]) => (name === '' ? value : `${name}: ${value}`));

describe('readingOf', () => {
  it('shows charge, voltage and supply status, and whether the battery is low or faulty', () => {
    const full = {
      header,
      voltage: 25.14,
      percentage: 0.872,
      current: Number.NaN,
      power_supply_status: 1,
      power_supply_health: 1,
    };
    expect(texts('battery', full)).toEqual(['87 %', '25.1 V', 'charging']);
    expect(readingOf(entry('battery'), full).level).toBe('ok');
    expect(readingOf(entry('battery'), { ...full, percentage: 0.15 }).level).toBe('warn');
    expect(readingOf(entry('battery'), { ...full, power_supply_health: 2 })).toMatchObject({
      level: 'error',
      values: expect.arrayContaining([['', 'overheated']]),
    });
    expect(texts('battery', { ...full, percentage: Number.NaN })).toEqual(['25.1 V', 'charging']);
  });

  it('shows position, kind of fix and accuracy', () => {
    const covariance = Float64Array.of(0.04, 0, 0, 0, 0.01, 0, 0, 0, 1);
    const message = {
      header,
      status: { status: 2, service: 1 },
      ...{ latitude: 48.137154, longitude: 11.576124, altitude: 519.04 },
      ...{ position_covariance: covariance, position_covariance_type: 2 },
    };
    expect(texts('fix', message)).toEqual([
      '48.1371540, 11.5761240',
      'ground augmented',
      '± 0.20 m',
      'altitude: 519.0 m',
    ]);
    expect(readingOf(entry('fix'), { ...message, status: { status: -1, service: 1 } })).toMatchObject({
      level: 'warn',
      values: [['', 'no fix']],
    });
  });

  it('shows the worst diagnostics first, and counts the rest', () => {
    const status = (level: number | string, name: string, message: string) => ({ level, name, message });
    const message = {
      header,
      status: [
        status(0, 'imu', 'fine'),
        status(1, 'left motor', 'warm'),
        status('\u0002', 'lidar', 'no data'),
      ],
    };
    expect(texts('diagnostics', message)).toEqual(['lidar: no data', 'left motor: warm', '1 of 3 OK']);
    expect(readingOf(entry('diagnostics'), message).level).toBe('error');
  });

  it('shows any other message as names and values', () => {
    expect(texts('text', { data: 21.123456789 })).toEqual(['21.1235']);
    const nested = { header, state: { mode: 'AUTO', armed: true }, cells: Float32Array.of(4, 4.5), big: 12n };
    expect(texts('text', nested)).toEqual([
      'state.mode: AUTO',
      'state.armed: true',
      'cells: [4, 4.5]',
      'big: 12',
    ]);
    expect(readingOf(entry('text', 'Mode'), nested).label).toBe('Mode');
  });

  it('is bounded for any input, or reports that the message is invalid', () => {
    const roles = fc.constantFrom<TopicRole>('battery', 'fix', 'diagnostics', 'text');
    const anything = fc.oneof(
      fc.anything({ withBigInt: true, withTypedArray: true, maxDepth: 6 }),
      fc.record({ data: anyText }),
      fc.record({
        header: fc.constant(header),
        status: fc.array(fc.record({ level: fc.integer(), name: fc.string(), message: fc.string() })),
      }),
    );
    let read = 0;
    fc.assert(
      fc.property(roles, anything, (as, message) => {
        let reading: ReturnType<typeof readingOf>;
        try {
          reading = readingOf(entry(as), message);
        } catch (error) {
          expect(error).toBeInstanceOf(Error);
          return;
        }
        read++;
        expect(readingSchema.safeParse({ type: 'reading', ...reading, ageMs: 0 }).success).toBe(true);
      }),
      longProperty(1, 100),
    );
    expect(read).toBeGreaterThan(0);
  });
});
