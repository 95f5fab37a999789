/** How severe each kind of event is, which part of the log it belongs to, and whether repetitions are counted. Pure. */
import type { EventDetail, EventGroup, EventKind, Severity } from './page-event.ts';

interface KindRow {
  readonly group: EventGroup;
  readonly severity: Severity;
  /** What comes again soon is counted in the entry that there is, instead of making another one. */
  readonly repeats?: true;
}

const table: Readonly<Record<EventKind, KindRow>> = {
  'page-opened': { group: 'page', severity: 'info' },
  signaling: { group: 'connection', severity: 'info', repeats: true },
  'robot-chosen': { group: 'connection', severity: 'info' },
  'robot-left': { group: 'connection', severity: 'info' },
  'session-began': { group: 'connection', severity: 'info' },
  'session-lost': { group: 'connection', severity: 'error', repeats: true },
  'path-lost': { group: 'connection', severity: 'warning', repeats: true },
  'path-restored': { group: 'connection', severity: 'info', repeats: true },
  'robot-silent': { group: 'link', severity: 'error', repeats: true },
  'robot-heard': { group: 'link', severity: 'info', repeats: true },
  'grant-ends': { group: 'connection', severity: 'warning' },
  'request-refused': { group: 'connection', severity: 'warning', repeats: true },
  'rate-fell': { group: 'link', severity: 'warning', repeats: true },
  'rate-recovered': { group: 'link', severity: 'info', repeats: true },
  'loss-high': { group: 'link', severity: 'warning', repeats: true },
  'loss-over': { group: 'link', severity: 'info', repeats: true },
  lease: { group: 'driving', severity: 'info' },
  handover: { group: 'driving', severity: 'info' },
  'command-refused': { group: 'driving', severity: 'warning', repeats: true },
  'other-drives': { group: 'driving', severity: 'warning', repeats: true },
  'grip-lost': { group: 'driving', severity: 'warning', repeats: true },
  stop: { group: 'stop', severity: 'error' },
  'stop-released': { group: 'stop', severity: 'info' },
  'stop-delivery': { group: 'stop', severity: 'info' },
  held: { group: 'limits', severity: 'warning', repeats: true },
  slowed: { group: 'limits', severity: 'info', repeats: true },
  free: { group: 'limits', severity: 'info', repeats: true },
  blocked: { group: 'limits', severity: 'warning', repeats: true },
  watchdog: { group: 'limits', severity: 'warning', repeats: true },
  'let-go-first': { group: 'limits', severity: 'warning', repeats: true },
  'guard-state': { group: 'limits', severity: 'info' },
  alarm: { group: 'alarms', severity: 'warning', repeats: true },
  'alarm-cleared': { group: 'alarms', severity: 'info', repeats: true },
  camera: { group: 'page', severity: 'info' },
  sensor: { group: 'page', severity: 'info' },
  setting: { group: 'page', severity: 'info' },
  recording: { group: 'page', severity: 'info' },
  latency: { group: 'page', severity: 'info' },
  'robot-fault': { group: 'page', severity: 'error', repeats: true },
  'page-failed': { group: 'page', severity: 'error', repeats: true },
  'picture-saved': { group: 'page', severity: 'info' },
  'clip-saved': { group: 'page', severity: 'info' },
  suppressed: { group: 'page', severity: 'warning' },
};

export function groupOf({ kind }: EventDetail): EventGroup {
  return table[kind].group;
}

/** Some kinds are as severe as what they say. */
export function severityOf(detail: EventDetail): Severity {
  if (detail.kind === 'alarm' && detail.level === 'error') return 'error';
  if (detail.kind === 'guard-state' && detail.state !== 'on') return 'warning';
  if (detail.kind === 'signaling' && (detail.state === 'waiting' || detail.state === 'refused'))
    return 'warning';
  if (detail.kind === 'stop-delivery' && detail.status !== 'confirmed')
    return detail.status === 'undelivered' ? 'error' : 'warning';
  return table[detail.kind].severity;
}

/**
 * What two events have in common that are counted as one: everything but their numbers. `null` if such an event has its own place
 * among the others, as who drives and who pressed STOP.
 */
export function repetitionKey(detail: EventDetail): string | null {
  if (table[detail.kind].repeats !== true) return null;
  return JSON.stringify(detail, (_, value: unknown) => (typeof value === 'number' ? 0 : value));
}
