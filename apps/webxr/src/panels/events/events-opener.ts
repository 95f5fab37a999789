/** Opens and closes the event log. Its code is loaded when it is first opened, so that the page starts without it. */
import type { EventLog } from '../../ground/events/event-log.ts';
import type { SessionReports } from '../../ground/report/session-reports.ts';
import type { Notices } from '../../state/notices.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { followKey } from '../ui/key-title.ts';
import { LaterPart } from '../ui/later-part.ts';
import { openDialog } from '../ui/open-dialog.ts';
import { quietButton } from '../ui/panel-parts.ts';
import type { Capturing } from './capture-buttons.ts';
import type { EventsDialog } from './events-dialog.ts';
import { showLastSession } from './last-session.ts';

export interface EventsOpenerParts {
  readonly log: EventLog;
  readonly reports: SessionReports;
  readonly notices: Pick<Notices, 'tell'>;
  readonly capture: Capturing;
}

export class EventsOpener {
  readonly #parts: EventsOpenerParts;
  readonly #code;
  #dialog: HTMLDialogElement | null = null;

  constructor(parts: EventsOpenerParts) {
    this.#parts = parts;
    this.#code = new LaterPart(() => import('./events-dialog.ts'), parts.notices);
  }

  /** Puts a button into the bar, and the last session's report below the list of robots. */
  start(): void {
    const { events, eventsTitle } = texts().dialogs;
    const button = quietButton(events, eventsTitle, () => this.toggle());
    followKey(button, 'events');
    button.id = 'events-open';
    elements.settingsOpen.before(button);
    showLastSession(this.#parts.reports);
  }

  toggle(): void {
    if (this.#dialog?.open === true) {
      this.#dialog.close();
      return;
    }
    void this.#code.use(({ EventsDialog }) => {
      this.#dialog ??= this.#build(EventsDialog);
      openDialog(this.#dialog);
    });
  }

  #build(Dialog: typeof EventsDialog): HTMLDialogElement {
    const { log, reports, capture } = this.#parts;
    const { element } = new Dialog(log, () => reports.all(performance.now()), capture);
    document.body.append(element);
    return element;
  }
}
