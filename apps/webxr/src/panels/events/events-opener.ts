/** Opens and closes the event log. Its code is loaded when it is first opened, so that the page starts without it. */
import type { EventLog } from '../../ground/events/event-log.ts';
import type { SessionReports } from '../../ground/report/session-reports.ts';
import type { Notices } from '../../state/notices.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { followKey } from '../ui/key-title.ts';
import { openDialog } from '../ui/open-dialog.ts';
import { quietButton } from '../ui/panel-parts.ts';
import type { Capturing } from './capture-buttons.ts';
import { showLastSession } from './last-session.ts';

export interface EventsOpenerParts {
  readonly log: EventLog;
  readonly reports: SessionReports;
  readonly notices: Pick<Notices, 'tell'>;
  readonly capture: Capturing;
}

export class EventsOpener {
  readonly #parts: EventsOpenerParts;
  #dialog: HTMLDialogElement | null = null;
  #loading = false;

  constructor(parts: EventsOpenerParts) {
    this.#parts = parts;
  }

  /** Puts a button into the bar, and the last session's report below the list of robots. */
  start(): void {
    const { open, openTitle } = texts().events;
    const button = quietButton(open, openTitle, () => void this.toggle());
    followKey(button, 'events');
    button.id = 'events-open';
    elements.settingsOpen.before(button);
    showLastSession(this.#parts.reports);
  }

  async toggle(): Promise<void> {
    if (this.#dialog?.open === true) {
      this.#dialog.close();
      return;
    }
    if (this.#loading) return;
    this.#loading = true;
    try {
      this.#dialog ??= await this.#load();
      openDialog(this.#dialog);
    } catch (error) {
      console.error(error);
      this.#parts.notices.tell(texts().events.loadFailed, 'warning');
    } finally {
      this.#loading = false;
    }
  }

  async #load(): Promise<HTMLDialogElement> {
    const { EventsDialog } = await import('./events-dialog.ts');
    const { log, reports, capture } = this.#parts;
    const { element } = new EventsDialog(log, () => reports.all(performance.now()), capture);
    document.body.append(element);
    return element;
  }
}
