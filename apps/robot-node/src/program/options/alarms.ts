/** Limits beyond which a value is an alarm. They can be set only in the configuration file. */
import { ALARM_TEXT_LENGTH, MAX_ALARMS, type Quantity } from '@farpoint/protocol';
import { defineOption } from '@farpoint/service';
import * as z from 'zod';
import type { AlarmRule } from '../../tell/alarms/alarm-board.ts';
import { STATE_QUANTITIES, watchName } from '../../tell/telemetry-board.ts';

const STATES = Object.keys(STATE_QUANTITIES) as (keyof typeof STATE_QUANTITIES)[];

const limit = z.number('must be a number').optional();
const side = z.strictObject({ warn: limit, error: limit }, 'must be a mapping with warn and error');

const alarmSchema = z
  .strictObject(
    {
      of: z
        .string('must be text')
        .min(1, 'must not be empty')
        .max(255, 'must be at most 255 characters long'),
      field: z.string('must be text').max(128, 'must be at most 128 characters long').optional(),
      low: side.optional(),
      high: side.optional(),
      hysteresis: z.number('must be a number').min(0, 'must be at least 0').default(0),
      text: z
        .string('must be text')
        .min(1, 'must not be empty')
        .max(ALARM_TEXT_LENGTH, `must be at most ${ALARM_TEXT_LENGTH} characters long`)
        .optional(),
    },
    'must be a mapping with of, and low or high',
  )
  .superRefine(({ low, high, hysteresis }, context) => {
    const fault = (message: string) => context.addIssue({ code: 'custom', message });
    const lows = [low?.error, low?.warn].filter((value) => value !== undefined);
    const highs = [high?.warn, high?.error].filter((value) => value !== undefined);
    const limits = [...lows, ...highs];
    if (limits.length === 0) fault('needs at least one limit: low or high, with warn or error');
    if (limits.some((value, i) => i > 0 && value < limits[i - 1]!))
      fault('must have its limits in order: low error, low warn, high warn, high error');
    // Otherwise an alarm of one side could be cleared only by raising one of the other.
    if (
      lows.length > 0 &&
      highs.length > 0 &&
      Math.max(...lows) + hysteresis > Math.min(...highs) - hysteresis
    )
      fault('must have low and high limits that are more than twice the hysteresis apart');
  });

export type AlarmOptions = z.output<typeof alarmSchema>;

export const DEFAULT_ALARMS: AlarmOptions[] = [
  {
    of: 'charge',
    low: { warn: 20, error: 10 },
    hysteresis: 2,
    text: 'The battery is low: drive to the charger',
  },
];

export const alarmsOptions = {
  alarms: defineOption({
    schema: z
      .array(alarmSchema, 'must be a list of alarms')
      .max(MAX_ALARMS, `must be at most ${MAX_ALARMS} alarms`),
    default: DEFAULT_ALARMS,
    flag: false,
    env: false,
    help: `limits of values, told to operators when they are exceeded: of (${STATES.join(', ')}, or a topic with its field), low and high with warn and error, hysteresis, text (docs/dashboard.md)`,
  }),
};

/**
 * What the alarms watch.
 *
 * @param refuse told of an alarm whose quantity the robot does not have
 */
export function toAlarmRules(
  alarms: readonly AlarmOptions[],
  quantities: readonly Quantity[],
  refuse: (detail: string) => void,
): AlarmRule[] {
  return alarms.flatMap(({ of, field, ...limits }) => {
    const own = field === undefined ? STATES.find((name) => name === of) : undefined;
    if (own !== undefined) return [{ ...limits, ...ownQuantity(own, quantities) }];
    const there = quantities.filter(({ topic }) => topic === of);
    const found = field === undefined ? there : there.filter((each) => each.field === field);
    const [quantity] = found;
    if (quantity === undefined || found.length > 1) {
      refuse(`${problem(of, field, there)}; it can be ${STATES.join(', ')}, or a topic with quantities`);
      return [];
    }
    const { label, unit } = quantity;
    return [{ ...limits, watches: watchName(quantity.topic, quantity.field), label, unit }];
  });
}

function problem(of: string, field: string | undefined, there: readonly Quantity[]): string {
  if (there.length === 0) return `cannot watch ${of}: the table of topics names no quantity of it`;
  const fields = there.map((each) => each.field).join(', ');
  return field === undefined
    ? `cannot watch ${of} without a field: ${fields}`
    : `cannot watch ${field} of ${of}, only ${fields}`;
}

const BATTERY_FIELDS = { charge: 'percentage', voltage: 'voltage' } as const;

/** A battery's own topic says when a value is unknown; the robot's state does not. */
function ownQuantity(name: keyof typeof STATE_QUANTITIES, quantities: readonly Quantity[]) {
  const field = name === 'speed' ? undefined : BATTERY_FIELDS[name];
  const battery = quantities.find((each) => each.field === 'percentage' && each.unit === '%');
  const measured = quantities.find((each) => each.topic === battery?.topic && each.field === field);
  const watches = measured === undefined ? name : watchName(measured.topic, measured.field);
  return { watches, ...STATE_QUANTITIES[name] };
}
