/**
 * Checks the clocks: the monotonic clock for everything that is timed, and the time of day for certificates and logs.
 */
import { ok, type Result, warn } from './finding.ts';
import type { Host } from './host.ts';

/** Reading these clocks accesses slow hardware, thousands of times a second. */
const SLOW_SOURCES = ['hpet', 'acpi_pm', 'jiffies', 'refined-jiffies', 'pit'];
/** Readings that are timed. Chosen: so many that one interruption hardly counts. */
const READINGS = 20_000;

export function checkMonotonicClock(host: Host, now: () => number): Result[] {
  const begin = now();
  let last = begin;
  let backwards = 0;
  for (let i = 0; i < READINGS; i++) {
    const reading = now();
    if (reading < last) backwards++;
    last = reading;
  }
  const source = host.read('/sys/devices/system/clocksource/clocksource0/current_clocksource');
  const nanoseconds = ((last - begin) / READINGS) * 1e6;
  const what = `monotonic clock${source === null ? '' : ` (${source})`}, ${nanoseconds.toFixed(0)} ns a reading`;
  if (backwards > 0)
    return [warn(`${what}, went back ${backwards} times`, 'use another kernel or clocksource')];
  if (source !== null && SLOW_SOURCES.includes(source))
    return [
      warn(
        what,
        'start the kernel with clocksource=tsc, or find out why it was dropped: `dmesg | grep -i tsc`',
      ),
    ];
  return [ok(what)];
}

export interface ServerTime {
  /** `Date` of the server's answer: whole seconds, ms since 1970. */
  dateMs: number;
  /** Our time of day when we sent the request and when the answer arrived, ms since 1970. */
  askedMs: number;
  answeredMs: number;
}

/**
 * Difference from the service's clock that is told, ms. Chosen: its answer comes in whole seconds; grants
 * bear a minute, and clocks that are kept in step differ by far less.
 */
const MOST_OFFSET_MS = 2000;

/** @param time `null` if no server gave the time */
export function checkTimeOfDay(time: ServerTime | null): Result[] {
  if (time === null)
    return [
      warn(
        'the time of day could not be checked',
        'it is compared with the signaling service once that answers',
      ),
    ];
  const { dateMs, askedMs, answeredMs } = time;
  // The server's time was within [date, date + 1 s).
  const offset = (askedMs + answeredMs) / 2 - (dateMs + 500);
  const uncertainty = 500 + (answeredMs - askedMs) / 2;
  const seconds = `${Math.abs(offset / 1000).toFixed(1)} s ${offset > 0 ? 'ahead of' : 'behind'}`;
  const what = `time of day ${seconds} the signaling service, ± ${(uncertainty / 1000).toFixed(1)} s`;
  if (Math.abs(offset) > MOST_OFFSET_MS + uncertainty)
    return [warn(what, '`timedatectl set-ntp true`: certificates and recordings need the correct time')];
  return [ok(what)];
}
