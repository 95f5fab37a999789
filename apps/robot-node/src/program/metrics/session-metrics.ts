import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of operators' sessions: how they began, why they ended, and what was refused. */
export function addSessionMetrics(metrics: PulledMetrics, { counters, operators }: MeasuredRobot): void {
  const { sessionsEnded, resumesRefused, answersIgnored, candidatesRefused, datagramsRefused } = counters;
  metrics.sum('sessions_opened', 'Sessions that operators requested', () => counters.sessionsOpened);
  metrics.sum('sessions_refused', 'Sessions refused: too many operators', () => counters.sessionsRefused);
  metrics.sums('sessions_ended', 'Sessions that ended, by reason', 'reason', () => sessionsEnded.entries());
  metrics.sum(
    'ice_restarts',
    'ICE restarts offered to operators that had lost their path',
    () => counters.iceRestarts,
  );
  metrics.sums('resumes_refused', 'Requests to resume a session that were refused', 'reason', () =>
    resumesRefused.entries(),
  );
  metrics.sums('grants_refused', 'Operators that were not admitted, by reason', 'reason', () =>
    counters.grantsRefused.entries(),
  );
  metrics.sums('revocation_lists', 'Lists of revoked grants that arrived, by outcome', 'outcome', () =>
    counters.revocationLists.entries(),
  );
  metrics.sums('answers_ignored', 'Answers that were ignored, by reason', 'reason', () =>
    answersIgnored.entries(),
  );
  metrics.sums('ice_candidates_refused', 'ICE candidates that were refused, by reason', 'reason', () =>
    candidatesRefused.entries(),
  );
  metrics.sums(
    'datagrams_refused',
    'Datagrams and packets of sessions that were dropped unread, by reason',
    'reason',
    () => datagramsRefused.entries(),
  );
  metrics.sums('messages_refused', 'Unreadable messages, by channel and error', 'reason', () =>
    counters.messagesRefused.entries(),
  );
  metrics.gauge('operators', 'Operators with a session', () => operators.size);
}
