/** The tab keeps the event log while the page is loaded anew. Only the operator clears it. */
import type { EventLog } from './event-log.ts';
import { eventsText, parseEvents } from './event-text.ts';

const KEY = 'farpoint.events';

export function keepEvents(log: EventLog): void {
  try {
    log.restore(parseEvents(sessionStorage.getItem(KEY)));
  } catch {
    // Without storage, events last until the page is left.
  }
  window.addEventListener('pagehide', () => {
    try {
      sessionStorage.setItem(KEY, eventsText(log.kept.peek()));
    } catch {
      // The same.
    }
  });
}
