/**
 * The event log in words: in the page's language for its panel, and in English, with typed fields, for files. Tables are
 * comma-separated values (RFC 4180), lists are JSON Lines. Pure.
 */
import type { KeptEvents } from '../ground/events/event-log.ts';
import { groupOf, severityOf } from '../ground/events/event-table.ts';
import type { EventDetail, EventGroup, PageEvent } from '../ground/events/page-event.ts';
import { type LaterTexts, laterEnglish } from './en/later-catalogue.ts';
import { laterTexts } from './language.ts';

/** What happened, as a sentence. @param said default: in the page's language */
export function eventText(detail: EventDetail, said: LaterTexts = laterTexts()): string {
  const say = said.events.kinds[detail.kind] as (detail: EventDetail) => string;
  return say(detail);
}

export interface EventFilter {
  /** `null`: all. */
  readonly group: EventGroup | null;
  /** Part of the sentence or of the robot's name, in any case; empty: all. */
  readonly text: string;
}

/** Whether the filter lets an event through. */
export function passes({ detail, robot }: PageEvent, { group, text }: EventFilter): boolean {
  if (group !== null && groupOf(detail) !== group) return false;
  const wanted = text.trim().toLowerCase();
  return wanted === '' || `${robot ?? ''} ${eventText(detail)}`.toLowerCase().includes(wanted);
}

/** What a file says of an event. */
interface WrittenEvent {
  /** ISO 8601, UTC. */
  readonly time: string;
  readonly lastTime: string;
  readonly times: number;
  /** Seconds since the session began; `null` without a session. */
  readonly sessionS: number | null;
  readonly robot: string | null;
  readonly severity: string;
  readonly kind: string;
  /** The typed parameters. */
  readonly details: Readonly<Record<string, unknown>>;
  /** The sentence, in English. */
  readonly text: string;
}

const HEAD = [
  'time',
  'lastTime',
  'times',
  'sessionS',
  'robot',
  'severity',
  'kind',
  'details',
  'text',
] as const satisfies (keyof WrittenEvent)[];

/** One JSON object a line, the oldest first. If older ones were dropped, the first says how many. */
export function eventsJsonLines(kept: KeptEvents): string {
  return writtenEvents(kept)
    .map((event) => `${JSON.stringify(event)}\n`)
    .join('');
}

/** The same as a table. A text that a spreadsheet would take for a formula begins with an apostrophe. */
export function eventsCsv(kept: KeptEvents): string {
  const rows = writtenEvents(kept).map((event) =>
    HEAD.map((name) => {
      const value = event[name];
      if (typeof value === 'number') return String(value);
      return cell(typeof value === 'string' ? value : value === null ? '' : JSON.stringify(value));
    }),
  );
  return [HEAD, ...rows].map((row) => `${row.join(',')}\r\n`).join('');
}

function writtenEvents({ events, dropped }: KeptEvents): WrittenEvent[] {
  const written = events.map(writtenEvent);
  const [oldest] = written;
  if (dropped === 0 || oldest === undefined) return written;
  const gap: WrittenEvent = {
    time: oldest.time,
    lastTime: oldest.time,
    times: dropped,
    sessionS: null,
    robot: null,
    severity: 'warning',
    kind: 'dropped',
    details: { count: dropped },
    text: laterEnglish.events.dropped(dropped),
  };
  return [gap, ...written];
}

function writtenEvent({ atMs, lastMs, times, sessionMs, robot, detail }: PageEvent): WrittenEvent {
  const { kind, ...details } = detail;
  return {
    time: new Date(atMs).toISOString(),
    lastTime: new Date(lastMs).toISOString(),
    times,
    sessionS: sessionMs === null ? null : Math.round(sessionMs) / 1000,
    robot,
    severity: severityOf(detail),
    kind,
    details,
    text: eventText(detail, laterEnglish),
  };
}

function cell(text: string): string {
  const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
