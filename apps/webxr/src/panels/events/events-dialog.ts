/** The event log as a list that can be filtered and saved. Loaded when it is first opened. */
import './events.css';
import { effect, signal } from '@preact/signals-core';
import type { EventLog } from '../../ground/events/event-log.ts';
import { EVENT_GROUPS } from '../../ground/events/page-event.ts';
import type { SessionReport } from '../../ground/report/report-schema.ts';
import { type EventFilter, eventsCsv, eventsJsonLines } from '../../words/event-words.ts';
import { laterTexts } from '../../words/language.ts';
import { quietButton, selectOf } from '../ui/panel-parts.ts';
import { saveFile, saveTable } from '../ui/save-file.ts';
import { type Capturing, captureButtons } from './capture-buttons.ts';
import { eventRow, eventTable, listedEvents } from './event-list.ts';
import { reportRow } from './report-row.ts';

/** What an operator has chosen, and what stays in place meanwhile. */
export class EventsDialog {
  readonly element = document.createElement('dialog');
  readonly #log: EventLog;
  readonly #filter = signal<EventFilter>({ group: null, text: '' });
  readonly #open = signal(false);
  readonly #rows = document.createElement('tbody');
  readonly #scrolled = document.createElement('div');
  readonly #count = document.createElement('p');
  readonly #newer: HTMLButtonElement;
  /** Number of the display frame that will list what is new. */
  #frame: number | null = null;
  /** How many events there had been when the list was made last. */
  #listed = 0;

  /** Makes it, closed. While it is closed it lists nothing. @param reports of this tab's sessions, as they are now */
  constructor(log: EventLog, reports: () => readonly SessionReport[], capture: Capturing) {
    this.#log = log;
    const { element } = this;
    element.id = 'events';
    element.setAttribute('aria-labelledby', 'events-title');
    this.#newer = quietButton('', '', () => this.#list());
    this.#newer.id = 'events-newer';
    this.#newer.hidden = true;
    this.#scrolled.className = 'scrolled';
    this.#scrolled.tabIndex = -1;
    this.#scrolled.append(eventTable(this.#rows));
    const row = reportRow(reports);
    row.element.append(...captureButtons(capture));
    element.append(this.#head(), row.element, this.#newer, this.#scrolled);
    new MutationObserver(() => {
      if (element.open) row.update();
      this.#open.value = element.open;
    }).observe(element, { attributeFilter: ['open'] });
    effect(() => {
      void this.#filter.value;
      if (this.#open.value) this.#list();
    });
    effect(() => {
      void log.revision.value;
      if (this.#open.value) this.#frame ??= requestAnimationFrame(() => this.#follow());
    });
  }

  /** Lists what is new, unless somebody reads further down: then a button says that there is more. */
  #follow(): void {
    this.#frame = null;
    const isRead = this.#scrolled.scrollTop > 0 || this.element.scrollTop > 0;
    if (!isRead) {
      this.#list();
      return;
    }
    const { events, dropped } = this.#log.kept;
    const news = events.length + dropped - this.#listed;
    this.#newer.hidden = news <= 0;
    this.#newer.textContent = laterTexts().events.newer(news);
  }

  #list(): void {
    const { rows, kept, dropped } = listedEvents(this.#log, this.#filter.peek());
    this.#listed = kept + dropped;
    this.#newer.hidden = true;
    this.#rows.replaceChildren(...rows.map(eventRow));
    const said = laterTexts().events;
    this.#count.textContent = kept === 0 ? said.empty : said.count(rows.length, kept, dropped);
    this.#scrolled.scrollTop = 0;
    this.element.scrollTop = 0;
  }

  #head(): HTMLElement {
    const said = laterTexts().events;
    const head = document.createElement('header');
    const title = document.createElement('h2');
    title.id = 'events-title';
    title.textContent = said.title;
    this.#count.className = 'count';
    const log = this.#log;
    const close = quietButton(said.close, said.close, () => this.element.close());
    // Enter and Space must not save or clear what nobody has looked at.
    close.autofocus = true;
    const lines = () => new Blob([eventsJsonLines(log.kept)], { type: 'application/jsonl' });
    head.append(
      title,
      quietButton(said.csv, said.csvTitle, () => saveTable('events', eventsCsv(log.kept))),
      quietButton(said.jsonLines, said.jsonLinesTitle, () => saveFile('events', 'jsonl', lines())),
      quietButton(said.clear, said.clearTitle, () => log.clear()),
      close,
      this.#groups(),
      this.#text(),
      this.#count,
    );
    return head;
  }

  #groups(): HTMLElement {
    const said = laterTexts().events;
    const choice = {
      label: said.filterGroup,
      values: ['all', ...EVENT_GROUPS] as const,
      texts: { all: said.all, ...said.groups },
    };
    return selectOf(choice, (chosen) => {
      this.#filter.value = { ...this.#filter.peek(), group: chosen === 'all' ? null : chosen };
    });
  }

  #text(): HTMLElement {
    const field = document.createElement('input');
    field.type = 'search';
    field.placeholder = laterTexts().events.filterText;
    field.ariaLabel = field.placeholder;
    field.maxLength = 100;
    field.addEventListener('input', () => {
      this.#filter.value = { ...this.#filter.peek(), text: field.value };
    });
    return field;
  }
}
