/** The texts with which the page tells of alarms. */
import type { Alarm } from '@farpoint/operator';
import type { Words } from './words.ts';

export function alarmWords({ level, text, value, limit, unit, recorded }: Alarm): Words {
  const withUnit = (number: number) => `${shortNumber(number)}${unit === '' ? '' : ` ${unit}`}`;
  return {
    text: `${recorded === true ? 'Recorded: ' : ''}${text} (${withUnit(value)}, limit ${withUnit(limit)})`,
    tone: level === 'error' ? 'bad' : 'warning',
  };
}

/** Errors before warnings; of each, those raised last first. */
export function raisedFirst(a: Alarm, b: Alarm): number {
  return Number(b.level === 'error') - Number(a.level === 'error') || b.sinceMs - a.sinceMs;
}

/** Three digits say enough about a value that is beyond a limit. */
function shortNumber(value: number): string {
  const size = Math.abs(value);
  if (size >= 100 || Number.isInteger(value)) return String(Math.round(value));
  return String(Number(value.toFixed(size >= 10 ? 1 : 2)));
}
