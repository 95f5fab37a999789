/** Reads the numbers of a topic's messages that are shown over time. */
import { MAX_QUANTITIES, QUANTITY_LIMITS, READING_LIMITS } from '@farpoint/protocol';
import * as z from 'zod';
import { BatteryGauge } from './battery-gauge.ts';
import { batteryDetailsSchema, navSatFixSchema } from './messages.ts';

/** A number in a topic's messages. */
export interface TopicQuantity {
  /** The path of the field, e.g. `motor.current` or `ranges[3]`. */
  field: string;
  /** For people. */
  label: string;
  /** Shown after the number. */
  unit: string;
}

/** What is needed of a topic's entry in the table. */
interface QuantityTopic {
  readonly topic: string;
  readonly as: string;
  readonly label?: string | undefined;
  readonly quantities?: z.output<typeof topicQuantitiesSchema> | undefined;
}

/** Quantities of a topic. Chosen: enough for what one sensor measures, six axes and two more. */
const MOST_OF_TOPIC = 8;
const FIELD = /^[A-Za-z_][A-Za-z0-9_]*(\[\d{1,6}\])?(\.[A-Za-z_][A-Za-z0-9_]*(\[\d{1,6}\])?)*$/;

const quantity = z.strictObject(
  {
    field: z
      .string('must be a field such as data or motor.current')
      .max(QUANTITY_LIMITS.field, `must be at most ${QUANTITY_LIMITS.field} characters`)
      .regex(FIELD, 'must be a field such as data, motor.current or ranges[3]')
      .default('data'),
    label: z
      .string('must be text')
      .min(1, 'must not be empty')
      .max(READING_LIMITS.label, `must be at most ${READING_LIMITS.label} characters`)
      .optional(),
    unit: z
      .string('must be text')
      .max(QUANTITY_LIMITS.unit, `must be at most ${QUANTITY_LIMITS.unit} characters`)
      .default(''),
  },
  'must be a mapping with field, label and unit',
);

/** The numbers of a `text` topic that the configuration chooses. */
export const topicQuantitiesSchema = z
  .array(quantity, 'must be a list of fields')
  .max(MOST_OF_TOPIC, `must be at most ${MOST_OF_TOPIC} fields`);

/** Those of the roles whose messages are known. */
const OF_ROLES: Readonly<Record<string, readonly TopicQuantity[]>> = {
  battery: [
    { field: 'percentage', label: 'Battery', unit: '%' },
    { field: 'voltage', label: 'Battery voltage', unit: 'V' },
    { field: 'current', label: 'Battery current', unit: 'A' },
  ],
  fix: [
    { field: 'latitude', label: 'Latitude', unit: '°' },
    { field: 'longitude', label: 'Longitude', unit: '°' },
    { field: 'altitude', label: 'Altitude', unit: 'm' },
  ],
};

/** The quantities of a topic, in the order of {@link numbersOf}. */
export function quantitiesOf({ topic, as, label, quantities = [] }: QuantityTopic): readonly TopicQuantity[] {
  const known = OF_ROLES[as];
  if (known !== undefined) return known;
  const own = label ?? topic.slice(-READING_LIMITS.label);
  return quantities.map(({ field, label = quantities.length === 1 ? own : field, unit }) => ({
    field,
    unit,
    label: label.slice(-READING_LIMITS.label),
  }));
}

/** All topics together may have as many as the protocol can number. */
export function tooManyQuantities(entries: readonly QuantityTopic[]): boolean {
  return entries.reduce((sum, entry) => sum + quantitiesOf(entry).length, 0) > MAX_QUANTITIES;
}

/**
 * The values of a message's quantities; `null` for those that it does not have, or that are not finite.
 *
 * @param gauge of the topic's battery
 * @throws {Error} if the message does not match its type
 */
export function numbersOf(
  entry: QuantityTopic,
  message: unknown,
  gauge = new BatteryGauge(),
): (number | null)[] {
  if (entry.as === 'battery') {
    const { share, voltage } = gauge.read(message);
    const { current } = batteryDetailsSchema.parse(message);
    return [share === null ? null : share * 100, voltage, finite(current)];
  }
  if (entry.as === 'fix') {
    const { status, latitude, longitude, altitude } = navSatFixSchema.parse(message);
    if (status.status < 0 || !Number.isFinite(latitude + longitude)) return [null, null, null];
    return [latitude, longitude, finite(altitude)];
  }
  return quantitiesOf(entry).map(({ field }) => finite(valueAt(message, field)));
}

function valueAt(message: unknown, field: string): unknown {
  let value = message;
  for (const key of field.split(/[.[\]]+/)) {
    if (key === '') continue;
    if (typeof value !== 'object' || value === null || !Object.hasOwn(value, key)) return undefined;
    value = (value as Record<string, unknown>)[key];
  }
  return value;
}

function finite(value: unknown): number | null {
  const number = typeof value === 'bigint' || typeof value === 'boolean' ? Number(value) : value;
  return typeof number === 'number' && Number.isFinite(number) ? number : null;
}
