/** The rows of the event log: the newest first, as far as the filter lets them through. */
import type { EventLog } from '../../ground/events/event-log.ts';
import { severityOf } from '../../ground/events/event-table.ts';
import type { PageEvent } from '../../ground/events/page-event.ts';
import { type EventFilter, eventText, passes } from '../../words/event-words.ts';
import { laterTexts } from '../../words/language.ts';

/** So many of the newest are listed; files have all. Chosen: more than anybody scrolls through, and made in a few ms. */
const MOST_LISTED = 300;

/** What is listed: the newest first. */
export interface ListedEvents {
  readonly rows: readonly PageEvent[];
  readonly kept: number;
  readonly dropped: number;
}

export function listedEvents({ kept }: Pick<EventLog, 'kept'>, filter: EventFilter): ListedEvents {
  const { events, dropped } = kept;
  const rows: PageEvent[] = [];
  for (let i = events.length - 1; i >= 0 && rows.length < MOST_LISTED; i--) {
    const event = events[i];
    if (event !== undefined && passes(event, filter)) rows.push(event);
  }
  return { rows, kept: events.length, dropped };
}

/** A table with an empty body. */
export function eventTable(body: HTMLElement): HTMLElement {
  const { time, robot, severity, what } = laterTexts().events;
  const table = document.createElement('table');
  const head = document.createElement('thead');
  const row = document.createElement('tr');
  for (const name of [time, robot, severity, what]) {
    const cell = document.createElement('th');
    cell.scope = 'col';
    cell.textContent = name;
    row.append(cell);
  }
  head.append(row);
  table.append(head, body);
  return table;
}

export function eventRow(event: PageEvent): HTMLElement {
  const { atMs, lastMs, times, robot, detail } = event;
  const said = laterTexts().events;
  const row = document.createElement('tr');
  const time = document.createElement('time');
  const at = new Date(atMs);
  time.dateTime = at.toISOString();
  time.textContent = at.toLocaleTimeString([], { timeStyle: 'medium' });
  time.title = at.toLocaleString();
  const severity = severityOf(detail);
  const level = cellOf(said.severities[severity]);
  level.dataset.severity = severity;
  const last = new Date(lastMs).toLocaleTimeString([], { timeStyle: 'medium' });
  const again = times > 1 ? ` (${said.again(times, last)})` : '';
  row.append(cellOf(time), cellOf(robot ?? '–'), level, cellOf(eventText(detail) + again));
  return row;
}

function cellOf(content: string | HTMLElement): HTMLTableCellElement {
  const cell = document.createElement('td');
  cell.append(content);
  return cell;
}
