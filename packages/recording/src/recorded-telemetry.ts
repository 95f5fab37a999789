/** Reads quantities, alarms and reports of components back from a recording. Each message is checked. */
import { ALARM_TEXT_LENGTH, QUANTITY_LIMITS, READING_LIMITS, readingLevels } from '@farpoint/protocol';
import * as z from 'zod';
import type { RecordedQuantity } from './recorder-messages.ts';
import type { RecordedTopic } from './recording.ts';
import { SINCE_KEY } from './telemetry-messages.ts';

export const SAMPLE_TYPES: readonly string[] = ['farpoint_msgs/msg/Sample'];
export const ALARM_TYPES: readonly string[] = ['farpoint_msgs/msg/Alarm'];

const header = z.object({ stamp: z.object({ sec: z.int(), nanosec: z.int().min(0) }) });

/** A quantity's value at the header's time. */
export const sampleRecordSchema = z.object({ header, value: z.number() });

/** An alarm that has had this level since the header's time. */
export const alarmRecordSchema = z.object({
  header,
  level: z.enum(readingLevels),
  text: z.string().min(1).max(ALARM_TEXT_LENGTH),
  value: z.number(),
  limit: z.number(),
  unit: z.string().max(QUANTITY_LIMITS.unit),
});

const sinceSchema = z.object({
  status: z.array(
    z.object({
      name: z.string(),
      values: z.array(z.object({ key: z.string(), value: z.string() })),
    }),
  ),
});

const text = (most: number) => z.string().min(1).max(most);
const metadataSchema = z.object({
  topic: text(READING_LIMITS.topic),
  field: z.string().max(QUANTITY_LIMITS.field),
  label: text(READING_LIMITS.label),
  unit: z.string().max(QUANTITY_LIMITS.unit),
});

/** The quantity whose samples a topic has. Where its recorder noted nothing about it, it is named after the topic. */
export function quantityOf({ name, metadata }: Pick<RecordedTopic, 'name' | 'metadata'>): RecordedQuantity {
  const { data } = metadataSchema.safeParse(Object.fromEntries(metadata ?? []));
  const topic = name.slice(-READING_LIMITS.topic);
  return data ?? { topic, field: 'value', label: name.slice(-READING_LIMITS.label), unit: '' };
}

/** Since when components have had their levels, ms since 1970; only of those whose report says so. */
export function sincesOf(message: unknown): Map<string, number> {
  const sinces = new Map<string, number>();
  for (const { name, values } of sinceSchema.safeParse(message).data?.status ?? []) {
    const ms = Date.parse(values.find(({ key }) => key === SINCE_KEY)?.value ?? '');
    if (Number.isFinite(ms)) sinces.set(name, ms);
  }
  return sinces;
}
