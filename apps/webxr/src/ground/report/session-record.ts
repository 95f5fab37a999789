/** Records one session for its report, in memory that does not grow with the session. Pure: time is passed in. */
import {
  type CommandStage,
  commandStages,
  type FrameStage,
  frameStages,
  type StageRow,
} from '@farpoint/operator';
import type { Telemetry } from '@farpoint/protocol';
import type { EventDetail } from '../events/page-event.ts';
import { InterventionCounts } from './intervention-counts.ts';
import { Quantiles, type Summary } from './quantiles.ts';
import { REPORT_FORMAT, REPORT_VERSION, type SessionReport } from './report-schema.ts';
import { Travel } from './travel.ts';

/** How a session begins. */
export interface SessionStart {
  readonly robot: SessionReport['robot'];
  readonly operator: SessionReport['operator'];
  /** ms since the epoch, and the page's clock. */
  readonly epochMs: number;
  readonly nowMs: number;
  /** The robot's limit, m/s. */
  readonly maxLinearMps: number;
}

/** Figures of one second; `null` for what is not known. */
export interface SessionSample {
  readonly bytesReceived: number;
  readonly packetsReceived: number;
  readonly packetsLost: number;
  readonly bitsPerSecond: number;
  readonly rttMs: number | null;
  readonly framesPerSecond: number;
  readonly pointsPerSecond: number;
  readonly displayFramesPerSecond: number;
  readonly viewAgeMs: number | null;
}

/** The stages of frames or of commands, and their total. */
class StageQuantiles<Stage extends string> {
  readonly total = new Quantiles();
  readonly #stages: ReadonlyMap<Stage, Quantiles>;

  constructor(stages: readonly Stage[]) {
    this.#stages = new Map(stages.map((stage) => [stage, new Quantiles()]));
  }

  add({ totalMs, stages }: StageRow<Stage>): void {
    if (totalMs !== null) this.total.add(totalMs);
    for (const [stage, quantiles] of this.#stages) {
      const ms = stages[stage];
      if (ms !== null) quantiles.add(ms);
    }
  }

  summaries(): Record<Stage, Summary | null> {
    const entries = [...this.#stages].map(([stage, quantiles]) => [stage, quantiles.summary()]);
    return Object.fromEntries(entries) as Record<Stage, Summary | null>;
  }
}

export class SessionRecord {
  readonly frames = new StageQuantiles<FrameStage>(frameStages);
  readonly commands = new StageQuantiles<CommandStage>(commandStages);
  readonly #start: SessionStart;
  readonly #travel: Travel;
  readonly #counts = new InterventionCounts();
  readonly #of = {
    kbitPerSecond: new Quantiles(),
    roundTripMs: new Quantiles(),
    framesPerSecond: new Quantiles(),
    pointsPerSecond: new Quantiles(),
    displayFramesPerSecond: new Quantiles(),
    ageMs: new Quantiles(),
    motionToPhotonMs: new Quantiles(),
  };
  #totals: Pick<SessionSample, 'bytesReceived' | 'packetsReceived' | 'packetsLost'> = {
    bytesReceived: 0,
    packetsReceived: 0,
    packetsLost: 0,
  };
  #end: { readonly reason: string; readonly nowMs: number } | null = null;

  constructor(start: SessionStart) {
    this.#start = start;
    this.#travel = new Travel(start.maxLinearMps);
  }

  onTelemetry(telemetry: Telemetry): void {
    this.#travel.observe(telemetry);
  }

  onEvent(detail: EventDetail, nowMs: number, times: number): void {
    this.#counts.observe(detail, nowMs, times);
    if (detail.kind === 'latency') this.#of.motionToPhotonMs.add(detail.mtpMs);
  }

  /** Call it once a second while the robot is heard. */
  onSample(sample: SessionSample): void {
    const { bytesReceived, packetsReceived, packetsLost } = sample;
    this.#totals = { bytesReceived, packetsReceived, packetsLost };
    const of = this.#of;
    of.kbitPerSecond.add(sample.bitsPerSecond / 1000);
    of.roundTripMs.add(sample.rttMs ?? Number.NaN);
    of.framesPerSecond.add(sample.framesPerSecond);
    of.pointsPerSecond.add(sample.pointsPerSecond);
    of.displayFramesPerSecond.add(sample.displayFramesPerSecond);
    of.ageMs.add(sample.viewAgeMs ?? Number.NaN);
  }

  /** @param reason a kind of loss, or `left` */
  end(reason: string, nowMs: number): void {
    if (this.#end !== null) return;
    this.#end = { reason, nowMs };
    this.#counts.end(nowMs);
  }

  report(nowMs: number): SessionReport {
    const { robot, operator, epochMs, nowMs: beganMs } = this.#start;
    const end = this.#end;
    const lastedMs = (end?.nowMs ?? nowMs) - beganMs;
    return {
      format: REPORT_FORMAT,
      version: REPORT_VERSION,
      robot,
      operator,
      beganMs: epochMs,
      endedMs: end === null ? null : epochMs + lastedMs,
      durationS: lastedMs / 1000,
      end: end?.reason ?? null,
      driving: this.#driving(nowMs),
      interventions: this.#interventions(),
      link: this.#link(),
      view: {
        framesPerSecond: this.#of.framesPerSecond.summary(),
        pointsPerSecond: this.#of.pointsPerSecond.summary(),
        displayFramesPerSecond: this.#of.displayFramesPerSecond.summary(),
        ageMs: this.#of.ageMs.summary(),
      },
      latency: {
        frameMs: this.frames.total.summary(),
        frameStagesMs: this.frames.summaries(),
        commandMs: this.commands.total.summary(),
        commandStagesMs: this.commands.summaries(),
        motionToPhotonMs: this.#of.motionToPhotonMs.summary(),
      },
    };
  }

  #driving(nowMs: number): SessionReport['driving'] {
    const { drivingS, standingS, unknownS, distanceM, jumps, topSpeedMps } = this.#travel;
    const leaseS = this.#counts.leaseMs(nowMs) / 1000;
    return { leaseS, drivingS, standingS, unknownS, distanceM, positionJumps: jumps, topSpeedMps };
  }

  #interventions(): SessionReport['interventions'] {
    const { counts, takeovers, stopsByName } = this.#counts;
    const { heldS, slowedS } = this.#travel;
    return {
      ...counts,
      stopsByName: Object.fromEntries(stopsByName),
      commandsRefused: { ...counts.commandsRefused },
      takeovers,
      heldS,
      slowedS,
    };
  }

  #link(): SessionReport['link'] {
    const { outages, outageMs, longestOutageMs, rateFalls } = this.#counts;
    return {
      ...this.#totals,
      kbitPerSecond: this.#of.kbitPerSecond.summary(),
      roundTripMs: this.#of.roundTripMs.summary(),
      outages,
      outageS: outageMs / 1000,
      longestOutageS: longestOutageMs / 1000,
      rateFalls,
    };
  }
}
