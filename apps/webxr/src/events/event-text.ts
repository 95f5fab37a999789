/** The event log as text: JSON lines, a table of comma-separated values (RFC 4180), and what the tab keeps. Pure. */
import * as z from 'zod/mini';
import { type KeptEvents, MOST_EVENTS, MOST_TEXT, type PageEvent, SEVERITIES } from './event-log.ts';

const HEAD = ['time', 'last_time', 'times', 'robot', 'severity', 'text'];

/** One row for each event, times in UTC. Texts that a spreadsheet would take for a formula begin with an apostrophe. */
export function eventsCsv(events: readonly PageEvent[]): string {
  const rows = events.map((event) => {
    const { time, lastTime, times, robot, severity, text } = written(event);
    return [time, lastTime, String(times), robot ?? '', severity, text].map(cell);
  });
  return [HEAD, ...rows].map((row) => `${row.join(',')}\r\n`).join('');
}

/** One JSON object a line, exactly as it was shown; times in UTC. */
export function eventsJsonLines(events: readonly PageEvent[]): string {
  return events.map((event) => `${JSON.stringify(written(event))}\n`).join('');
}

function written({ atMs, lastMs, times, robot, severity, text }: PageEvent) {
  return { time: utc(atMs), lastTime: utc(lastMs), times, robot, severity, text };
}

function utc(ms: number): string {
  return new Date(ms).toISOString();
}

function cell(text: string): string {
  const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

/** The last ms that a date can have. */
const LAST_MS = 8.64e15;
const time = z.number().check(z.minimum(0), z.maximum(LAST_MS));
const count = z.int().check(z.minimum(0));
const event = z.object({
  ...{ atMs: time, lastMs: time },
  times: z.int().check(z.minimum(1)),
  robot: z.nullable(z.string().check(z.maxLength(MOST_TEXT))),
  severity: z.enum(SEVERITIES),
  text: z.string().check(z.maxLength(MOST_TEXT)),
});
const schema = z.object({ events: z.array(event).check(z.maxLength(MOST_EVENTS)), dropped: count });

/** What {@link parseEvents} reads. */
export function eventsText(kept: KeptEvents): string {
  return JSON.stringify(kept);
}

/** Nothing if the text is not what {@link eventsText} writes. */
export function parseEvents(text: string | null): KeptEvents {
  try {
    const { success, data } = schema.safeParse(JSON.parse(text ?? 'null'));
    if (success) return data;
  } catch {
    // It is no JSON.
  }
  return { events: [], dropped: 0 };
}
