/** Gathers what the reports of sessions are made of: the client's events, the log's events, and figures once a second. */
import type { CommandStages, FrameStages, RobotClient, StageRow } from '@farpoint/operator';
import { effect, untracked } from '@preact/signals-core';
import type { EventLog } from '../../ground/events/event-log.ts';
import type { SessionReports } from '../../ground/report/session-reports.ts';
import type { PageState } from '../page-state.ts';

/** Figures are taken at this interval, ms. Chosen: an hour has as many as a percentile needs; feed-reports.test.ts holds it. */
const SAMPLE_MS = 1000;
/** Stages are taken at this interval, ms: well within the time for which they are kept (STAGES_KEPT_MS, 30 s). */
const STAGES_MS = 5000;
/** The robot tells the times of a row at most so much later, ms, as in stage-window.ts. */
const TOLD_WITHIN_MS = 5000;

type Windowed<Stage extends string> = { readonly window: { rows(nowMs: number): StageRow<Stage>[] } };

export interface ReportSources {
  readonly reports: SessionReports;
  readonly log: EventLog;
  readonly client: Pick<RobotClient, 'on'> & {
    readonly statistics: {
      frameStages(): Windowed<keyof ReturnType<FrameStages['window']['summary']>['stages']> | null;
      readonly commands: Windowed<keyof ReturnType<CommandStages['window']['summary']>['stages']>;
    };
  };
  readonly state: Pick<PageState, 'link' | 'figures' | 'sampledAtMs'>;
  /** What the operator calls itself, where no grant says. */
  readonly operator: string;
  /** ms since the epoch. */
  epochMs(): number;
  /** Page's clock, ms. */
  now(): number;
}

export function feedReports(sources: ReportSources): void {
  const { reports, log, client, operator, epochMs, now } = sources;
  const stages = new StageReader(sources);
  log.onEvent = (detail, times) => reports.current?.onEvent(detail, now(), times);
  const end = (reason: string) => {
    if (reports.current === null) return;
    stages.read(now(), 0);
    reports.end(reason, now());
  };
  client.on('welcome', ({ robotId, name, access, limits }) => {
    end('new-session');
    stages.begin(now());
    reports.begin({
      robot: { id: robotId, name },
      operator: { name: access?.name ?? operator, role: access?.role ?? null },
      epochMs: epochMs(),
      nowMs: now(),
      maxLinearMps: Math.max(limits.maxLinear, limits.maxLateral ?? 0),
    });
  });
  client.on('telemetry', (telemetry) => reports.current?.onTelemetry(telemetry));
  client.on('loss', end);
  client.on('phase', (phase) => {
    if (phase !== 'live') end('left');
  });
  sampleFigures(sources, stages);
}

function sampleFigures({ reports, state }: ReportSources, stages: StageReader): void {
  let [sampleDueMs, stagesDueMs] = [0, 0];
  effect(() => {
    const nowMs = state.sampledAtMs.value;
    if (nowMs < sampleDueMs || !state.link.live.peek()) return;
    sampleDueMs = nowMs + SAMPLE_MS;
    untracked(() => {
      if (state.link.heard.peek()) sample(reports, state);
      if (nowMs < stagesDueMs) return;
      stagesDueMs = nowMs + STAGES_MS;
      stages.read(nowMs, TOLD_WITHIN_MS);
    });
  });
}

function sample(reports: SessionReports, state: ReportSources['state']): void {
  const figures = state.figures.peek();
  const { framesPerSecond, pointsPerFrame } = figures;
  reports.current?.onSample({
    bytesReceived: figures.bytesReceived,
    packetsReceived: figures.packetsReceived,
    packetsLost: figures.packetsLost,
    bitsPerSecond: figures.bitsPerSecond,
    rttMs: figures.rttMs,
    framesPerSecond,
    pointsPerSecond: framesPerSecond * pointsPerFrame,
    displayFramesPerSecond: figures.displayFramesPerSecond,
    viewAgeMs: figures.viewAgeMs,
  });
}

/** Reads each row of the stages once, when its times have been told. */
class StageReader {
  readonly #sources: Pick<ReportSources, 'reports' | 'client'>;
  #readMs = 0;

  constructor(sources: Pick<ReportSources, 'reports' | 'client'>) {
    this.#sources = sources;
  }

  /** A session begins. */
  begin(nowMs: number): void {
    this.#readMs = nowMs;
  }

  /** @param withinMs rows that ended since may still be told of, and are left for later */
  read(nowMs: number, withinMs: number): void {
    const { reports, client } = this.#sources;
    const { current } = reports;
    if (current === null) return;
    const [fromMs, toMs] = [this.#readMs, nowMs - withinMs];
    if (toMs <= fromMs) return;
    this.#readMs = toMs;
    const isNew = ({ endedMs }: StageRow<string>) => endedMs > fromMs && endedMs <= toMs;
    for (const row of client.statistics.frameStages()?.window.rows(nowMs) ?? [])
      if (isNew(row)) current.frames.add(row);
    for (const row of client.statistics.commands.window.rows(nowMs))
      if (isNew(row)) current.commands.add(row);
  }
}
