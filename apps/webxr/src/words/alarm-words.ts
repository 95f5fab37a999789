/** The texts with which the page tells of alarms. */
import { type Alarm, LOST_AFTER_MS } from '@farpoint/operator';
import { texts } from './language.ts';
import { marked } from './numbers.ts';
import type { Words } from './words.ts';

/** @param silentMs how long nothing has been heard of the robot, ms */
export function alarmWords({ level, text, value, limit, unit, recorded }: Alarm, silentMs: number): Words {
  const said = texts().figures;
  const withUnit = (number: number) => `${shortNumber(number)}${unit === '' ? '' : ` ${unit}`}`;
  const alarm = said.alarm(text, withUnit(value), withUnit(limit));
  const full = recorded === true ? said.recorded(alarm) : alarm;
  return {
    text: silentMs >= LOST_AFTER_MS ? said.alarmAgo(full, Math.round(silentMs / 1000)) : full,
    tone: level === 'error' ? 'bad' : 'warning',
  };
}

/** The worst alarm and the number of the others in one line. @param alarms the worst first */
export function alarmLine([first, ...others]: readonly Words[]): Words | null {
  if (first === undefined) return null;
  const text = others.length === 0 ? first.text : texts().figures.andMore(first.text, others.length);
  return { text: `⚠ ${text}`, tone: first.tone };
}

/** Errors before warnings; of each, those raised last first. */
export function raisedFirst(a: Alarm, b: Alarm): number {
  return Number(b.level === 'error') - Number(a.level === 'error') || b.sinceMs - a.sinceMs;
}

/** Three digits say enough about a value that is beyond a limit. */
function shortNumber(value: number): string {
  const size = Math.abs(value);
  if (size >= 100 || Number.isInteger(value)) return String(Math.round(value));
  return marked(String(Number(value.toFixed(size >= 10 ? 1 : 2))));
}
