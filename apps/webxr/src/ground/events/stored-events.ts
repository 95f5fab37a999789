/** The tab keeps the event log while the page is loaded anew, until the operator clears it or closes the tab. */
import * as z from 'zod/mini';
import { type EventLog, type KeptEvents, MOST_EVENTS } from './event-log.ts';
import { eventSchema } from './page-event.ts';

const KEY = 'farpoint.events';

const schema = z.object({
  events: z.array(eventSchema).check(z.maxLength(MOST_EVENTS)),
  dropped: z.int().check(z.minimum(0)),
});

/** Nothing if the text is not what {@link keptText} writes. */
export function parseKept(text: string | null): KeptEvents {
  try {
    const { success, data } = schema.safeParse(JSON.parse(text ?? 'null'));
    if (success) return data;
  } catch {
    // It is no JSON.
  }
  return { events: [], dropped: 0 };
}

/** What {@link parseKept} reads. */
export function keptText(kept: KeptEvents): string {
  return JSON.stringify(kept);
}

/** Where a tab keeps what belongs to it. */
type TabStorage = Pick<Storage, 'getItem' | 'setItem'>;

/**
 * Takes back what the tab has kept, and keeps what there is whenever the page is hidden or left.
 *
 * @param page tells of that
 * @param storage throws if the page may not use it: then events last until the page is left
 */
export function keepEvents(log: EventLog, page: EventTarget, storage: () => TabStorage): void {
  try {
    log.restore(parseKept(storage().getItem(KEY)));
  } catch {
    // The page may store nothing.
  }
  const keep = () => {
    try {
      storage().setItem(KEY, keptText(log.kept));
    } catch {
      // The same, or its room is used up.
    }
  };
  page.addEventListener('pagehide', keep);
  page.addEventListener('visibilitychange', keep);
}
