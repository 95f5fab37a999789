import { topicTableSchema } from '@farpoint/ros';
import { describe, expect, it } from 'vitest';
import type * as z from 'zod';
import { describeQuantities } from '../../tell/sample-board.ts';
import { type AlarmOptions, alarmsOptions, DEFAULT_ALARMS, toAlarmRules } from './alarms.ts';

const schema = alarmsOptions.alarms.schema as z.ZodType<AlarmOptions[]>;
const parse = (...alarms: object[]) => schema.parse(alarms);
const faultOf = (...alarms: object[]) => schema.safeParse(alarms).error?.issues[0]?.message;

describe('the alarms of a configuration', () => {
  it('need limits, in order, and apart from each other', () => {
    expect(faultOf({ of: 'speed' })).toContain('at least one limit');
    expect(faultOf({ of: 'speed', high: { warn: 2, error: 1 } })).toContain('in order');
    expect(faultOf({ of: 'speed', low: { warn: 3 }, high: { warn: 2 } })).toContain('in order');
    expect(faultOf({ of: 'speed', low: { warn: 1 }, high: { warn: 2 }, hysteresis: 0.6 })).toContain('apart');
    expect(faultOf({ of: 'speed', high: { warn: 1 }, hysteresis: -1 })).toContain('at least 0');
    expect(faultOf({ of: 'speed', high: { warn: 1 }, limit: 3 })).toContain('mapping');
    expect(parse({ of: 'speed', low: { error: -1, warn: 0 }, high: { warn: 1, error: 2 } })).toHaveLength(1);
  });

  it('watch the robot’s own state, or a quantity of a topic', () => {
    const topics = topicTableSchema.parse([
      { topic: '/gripper', type: 'a/B', as: 'text', quantities: [{ label: 'Gripper', unit: '°C' }] },
      { topic: '/arm', type: 'a/B', as: 'text', quantities: [{ field: 'a' }, { field: 'b', unit: 'A' }] },
    ]);
    const refused: string[] = [];
    const rules = toAlarmRules(
      parse(
        { of: 'speed', high: { warn: 1 } },
        { of: '/gripper', high: { warn: 60 } },
        { of: '/arm', field: 'b', high: { warn: 3 } },
        { of: '/arm', high: { warn: 3 } },
        { of: '/arm', field: 'c', high: { warn: 3 } },
        { of: 'sped', high: { warn: 3 } },
      ),
      describeQuantities(topics),
      (detail) => refused.push(detail),
    );
    expect(rules.map(({ watches, label, unit }) => [watches, label, unit])).toEqual([
      ['speed', 'Speed', 'm/s'],
      ['/gripper data', 'Gripper', '°C'],
      ['/arm b', 'b', 'A'],
    ]);
    expect(refused.map((detail) => detail.split(';')[0])).toEqual([
      'cannot watch /arm without a field: a, b',
      'cannot watch c of /arm, only a, b',
      'cannot watch sped: the table of topics names no quantity of it',
    ]);
  });

  it('by default watch the battery: at its own topic, where there is one', () => {
    const watched = (topics: object[]) =>
      toAlarmRules(DEFAULT_ALARMS, describeQuantities(topicTableSchema.parse(topics)), () => {})[0]?.watches;
    expect(watched([])).toBe('charge');
    expect(watched([{ topic: '/battery', as: 'battery' }])).toBe('/battery percentage');
  });
});
