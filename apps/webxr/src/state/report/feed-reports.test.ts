import type { StageRow } from '@farpoint/operator';
import { signal } from '@preact/signals-core';
import { beforeEach, expect, test } from 'vitest';
import { EventLog } from '../../ground/events/event-log.ts';
import { SessionReports } from '../../ground/report/session-reports.ts';
import { feedReports, type ReportSources } from './feed-reports.ts';

function setUp() {
  const clock = { ms: 10_000 };
  const listeners = new Map<string, (event: unknown) => void>();
  const rows: StageRow<string>[] = [];
  const window = { rows: () => rows };
  const client = {
    on: (type: string, listener: (event: unknown) => void) => listeners.set(type, listener),
    statistics: { frameStages: () => ({ window }), commands: { window: { rows: () => [] } } },
  };
  const [live, heard, sampledAtMs] = [signal(true), signal(true), signal(0)];
  const figures = signal({
    bitsPerSecond: 1000,
    framesPerSecond: 10,
    pointsPerFrame: 50,
    rttMs: null,
    viewAgeMs: null,
  });
  const reports = new SessionReports();
  const log = new EventLog(() => 0);
  feedReports({
    reports,
    log,
    client: client as unknown as ReportSources['client'],
    state: { link: { live, heard }, figures, sampledAtMs } as unknown as ReportSources['state'],
    operator: 'Ann',
    epochMs: () => 1_700_000_000_000,
    now: () => clock.ms,
  });
  const emit = (type: string, event?: unknown) => listeners.get(type)?.(event);
  const welcome = (more: object = {}) =>
    emit('welcome', { robotId: 'rover-1', name: 'Rover', limits: { maxLinear: 1 }, ...more });
  /** Time passes; a sample is taken four times a second. */
  const pass = (ms: number) => {
    const endMs = clock.ms + ms;
    while (clock.ms < endMs) {
      clock.ms += 250;
      sampledAtMs.value = clock.ms;
    }
  };
  const show = (endedMs: number) =>
    void rows.push({ number: 0, endedMs, totalMs: 50, stages: {}, told: true });
  return { clock, reports, log, heard, figures, emit, welcome, pass, show };
}

let page: ReturnType<typeof setUp>;
beforeEach(() => {
  page = setUp();
});

test('a report begins with the welcome, and ends with the loss, or when the operator leaves', () => {
  const { reports, welcome, emit, clock } = page;
  emit('loss', 'not-connected');
  expect(reports.all(0)).toEqual([]);
  welcome({ access: { name: 'Ann Smith', role: 'supervise' } });
  clock.ms += 4000;
  emit('loss', 'silent');
  emit('phase', 'waiting');
  welcome();
  emit('phase', 'live');
  welcome();
  emit('phase', 'none');
  expect(reports.all(0).map(({ end, operator }) => [end, operator.name])).toEqual([
    ['left', 'Ann'],
    ['new-session', 'Ann'],
    ['silent', 'Ann Smith'],
  ]);
  expect(reports.ended.value[2]).toMatchObject({ durationS: 4, robot: { id: 'rover-1', name: 'Rover' } });
});

test('figures are taken once a second, while the robot is heard', () => {
  const { reports, welcome, pass, heard } = page;
  welcome();
  pass(10_000);
  const view = () => reports.all(0)[0]?.view;
  expect(view()?.pointsPerSecond).toMatchObject({ count: 10, mean: 500 });
  heard.value = false;
  pass(5000);
  expect(view()?.pointsPerSecond?.count).toBe(10);
});

test('each row of the stages counts once, when it has been told, and the last at the end', () => {
  const { reports, welcome, pass, show, emit, clock } = page;
  show(clock.ms - 100);
  welcome();
  const counted = () => reports.all(0)[0]?.latency.frameMs?.count ?? 0;
  show(clock.ms + 1000);
  pass(4000);
  expect(counted()).toBe(0);
  pass(8000);
  expect(counted()).toBe(1);
  show(clock.ms - 100);
  pass(30_000);
  expect(counted()).toBe(2);
  show(clock.ms - 100);
  emit('phase', 'none');
  expect(counted()).toBe(3);
});

test('all that is logged counts, also what the log only counts', () => {
  const { reports, log, welcome, emit } = page;
  welcome();
  for (let i = 0; i < 3; i++)
    log.add({ kind: 'held', reasons: ['obstacle'] }, { robot: null, sessionMs: null });
  emit('telemetry', {
    timeMs: 0,
    pose: { position: { x: 0, y: 0, z: 0 } },
    twist: { linear: { x: 0.7, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } },
  });
  expect(reports.all(0)[0]).toMatchObject({ interventions: { held: 3 }, driving: { topSpeedMps: 0.7 } });
});
