/** Lets the page log what happens and report on its sessions, and lets the tab keep both while it is loaded anew. */
import type { RobotClient } from '@farpoint/operator';
import type { EventLog } from '../ground/events/event-log.ts';
import { keepEvents } from '../ground/events/stored-events.ts';
import type { SessionReports } from '../ground/report/session-reports.ts';
import { keepReports } from '../ground/report/stored-reports.ts';
import type { Settings } from '../ground/settings.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import { type AddEvent, feedEvents } from '../state/events/feed-events.ts';
import type { PageState } from '../state/page-state.ts';
import { feedReports } from '../state/report/feed-reports.ts';
import type { PageViews } from './page-views.ts';

export interface LoggedParts {
  readonly events: EventLog;
  readonly reports: SessionReports;
  readonly client: RobotClient;
  readonly state: PageState;
  readonly settings: Settings;
  readonly appearance: CloudAppearance;
  readonly views: Pick<PageViews, 'predicted'>;
}

/** Call it before the client starts. @returns adds what the page itself has done */
export function logPage({
  events,
  reports,
  client,
  state,
  settings,
  appearance,
  views,
}: LoggedParts): AddEvent {
  const { on } = views.predicted;
  const now = () => performance.now();
  const storage = () => sessionStorage;
  keepEvents(events, window, storage);
  keepReports(reports, window, storage, now);
  // The reports count the events, so they must know of a session before its events come, and of its end after them.
  feedReports({
    reports,
    log: events,
    client,
    state,
    operator: settings.name,
    epochMs: () => Date.now(),
    now,
  });
  const add = feedEvents({
    log: events,
    client,
    state,
    settings: {
      predict: () => on.value,
      synchronised: () => settings.synchronised,
      cues: () => settings.cues,
      clips: () => settings.clips,
      surface: () => appearance.drawsSurface.value,
      hazards: () => appearance.hazards.value,
      remembers: () => appearance.remembers.value,
    },
    operator: settings.name,
    now,
  });
  logErrors(add);
  return add;
}

/** What nobody has caught. */
function logErrors(add: AddEvent): void {
  window.addEventListener('error', ({ message }) => {
    // That panels are measured again in the next frame is no error.
    if (!message.startsWith('ResizeObserver loop')) add({ kind: 'page-failed', detail: message });
  });
  window.addEventListener('unhandledrejection', ({ reason }) =>
    add({ kind: 'page-failed', detail: String(reason) }),
  );
}
