/** The event log, as a list that can be filtered and saved. Loaded when it is first opened. */
import './help.css';
import './events.css';
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import { type EventLog, type PageEvent, SEVERITIES, type Severity } from '../events/event-log.ts';
import { eventsCsv, eventsJsonLines } from '../events/event-text.ts';
import { eventsWords, filterWords, severityTones } from '../status/event-words.ts';
import { dialogButton } from './dialog-parts.ts';
import { selectOf } from './panel-parts.ts';
import { saveFile } from './save-file.ts';
import { menuOf, sheetOf, textOf } from './sheet-parts.ts';

/** So many of the newest are listed; files have all. */
const MOST_LISTED = 250;

/** Makes the dialog, closed. While it is closed it lists nothing. */
export function eventsDialog(log: EventLog): HTMLDialogElement {
  const dialog = sheetOf('events', 'Event log');
  const least = signal<Severity>('info');
  const isOpen = signal(false);
  new MutationObserver(() => {
    isOpen.value = dialog.open;
  }).observe(dialog, { attributeFilter: ['open'] });
  const count = textOf('p', '', 'hint small');
  const list = document.createElement('tbody');
  const save = (extension: string, type: string, write: (events: readonly PageEvent[]) => string) => () =>
    saveFile('events', extension, new Blob([write(log.kept.peek().events)], { type }));
  const csv = dialogButton('CSV', 'CSV: save all events as a table', save('csv', 'text/csv', eventsCsv));
  const lines = dialogButton(
    'JSON lines',
    'JSON lines: save all events',
    save('jsonl', 'application/jsonl', eventsJsonLines),
  );
  const clear = dialogButton('Clear', 'Clear: forget all events', () => log.clear());
  dialog.append(
    menuOf(
      filterOf(least),
      csv,
      lines,
      clear,
      dialogButton('Close', 'Close', () => dialog.close()),
    ),
    count,
    tableOf(list),
  );
  const listed: ReadonlySignal<readonly PageEvent[]> = computed(() => {
    if (!isOpen.value) return [];
    const from = SEVERITIES.indexOf(least.value);
    return log.kept.value.events.filter(({ severity }) => SEVERITIES.indexOf(severity) >= from);
  });
  effect(() => {
    const { events, dropped } = log.kept.value;
    for (const button of [csv, lines, clear]) button.disabled = events.length === 0;
    const shown = Math.min(listed.value.length, MOST_LISTED);
    count.textContent = eventsWords({ shown, kept: events.length, dropped });
  });
  effect(() => {
    list.replaceChildren(...listed.value.slice(-MOST_LISTED).reverse().map(rowOf));
  });
  return dialog;
}

function filterOf(least: { value: Severity }): HTMLElement {
  const label = document.createElement('label');
  const names = SEVERITIES.map((severity) => filterWords[severity]);
  const select = selectOf('Show events', names, (name) => {
    least.value = SEVERITIES[names.indexOf(name)] ?? 'info';
  });
  label.append('Show', select);
  return label;
}

function tableOf(list: HTMLElement): HTMLElement {
  const table = document.createElement('table');
  const head = document.createElement('thead');
  const row = document.createElement('tr');
  for (const name of ['Time', 'Robot', 'Severity', 'What happened']) {
    const cell = textOf('th', name);
    cell.scope = 'col';
    row.append(cell);
  }
  head.append(row);
  table.append(head, list);
  return table;
}

function rowOf({ atMs, lastMs, times, robot, severity, text }: PageEvent): HTMLElement {
  const row = document.createElement('tr');
  const when = document.createElement('td');
  const time = textOf('time', new Date(atMs).toLocaleString([], { dateStyle: 'short', timeStyle: 'medium' }));
  time.dateTime = new Date(atMs).toISOString();
  when.append(time);
  const level = textOf('td', severity);
  level.dataset.tone = severityTones[severity];
  const again =
    times > 1
      ? ` (${times} times, last at ${new Date(lastMs).toLocaleTimeString([], { timeStyle: 'medium' })})`
      : '';
  row.append(when, textOf('td', robot ?? '–'), level, textOf('td', text + again));
  return row;
}
