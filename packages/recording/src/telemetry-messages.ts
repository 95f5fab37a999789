/** Quantities, alarms and reports of components as ROS 2 messages in CDR. */
import type { Alarm, DiagnosticReport } from '@farpoint/protocol';
import { DIAGNOSTIC_LEVELS } from '@farpoint/ros';
import { ALARM_SCHEMA, DIAGNOSTIC_ARRAY_SCHEMA, SAMPLE_SCHEMA } from './ros-schemas.ts';
import { cdrText, headerOf, writerOf } from './ros-writer.ts';

/** The key under which a component's report says since when it has had its level. */
export const SINCE_KEY = 'since';

const NS_PER_MS = 1_000_000n;

const samples = writerOf(SAMPLE_SCHEMA);
const alarms = writerOf(ALARM_SCHEMA);
const diagnostics = writerOf(DIAGNOSTIC_ARRAY_SCHEMA);

/** @param measuredNs when it was measured */
export function sampleMessage(measuredNs: bigint, value: number): Uint8Array {
  return samples.writeMessage({ header: headerOf(measuredNs, ''), value });
}

/** @param sinceNs since when the alarm has had its level */
export function alarmMessage(
  sinceNs: bigint,
  { level, text, value, limit, unit }: Pick<Alarm, 'level' | 'text' | 'value' | 'limit' | 'unit'>,
): Uint8Array {
  const texts = { level, text: cdrText(text), unit: cdrText(unit) };
  return alarms.writeMessage({ header: headerOf(sinceNs, ''), ...texts, value, limit });
}

/** @param nsOf converts the robot's clock to the time since 1970 */
export function diagnosticArray(
  stampNs: bigint,
  reports: readonly DiagnosticReport[],
  nsOf: (ms: number) => bigint,
): Uint8Array {
  const status = reports.map(({ name, level, message, sinceMs }) => ({
    level: DIAGNOSTIC_LEVELS.indexOf(level),
    name: cdrText(name),
    message: cdrText(message),
    hardware_id: '',
    values: [{ key: SINCE_KEY, value: new Date(Number(nsOf(sinceMs) / NS_PER_MS)).toISOString() }],
  }));
  return diagnostics.writeMessage({ header: headerOf(stampNs, ''), status });
}
