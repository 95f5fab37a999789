/** The tab keeps the reports of its sessions while the page is loaded anew. */
import type { SessionReports } from './session-reports.ts';

const KEY = 'farpoint.reports';

/**
 * Takes back what the tab has kept, and keeps what there is when the page is left. A session that lasts then is over.
 *
 * @param page tells of that
 * @param storage throws if the page may not use it: then reports last until the page is left
 * @param now page's clock, ms
 */
export function keepReports(
  reports: SessionReports,
  page: EventTarget,
  storage: () => Pick<Storage, 'getItem' | 'setItem'>,
  now: () => number,
): void {
  try {
    reports.restore(storage().getItem(KEY));
  } catch {
    // The page may store nothing.
  }
  page.addEventListener('pagehide', () => {
    try {
      storage().setItem(KEY, reports.text('page-left', now()));
    } catch {
      // The same, or its room is used up.
    }
  });
}
