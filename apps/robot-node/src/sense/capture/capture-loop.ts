import type { BaseState, FrameSource } from '@farpoint/cloud-source';
import { EvenPace } from '@farpoint/timing';
import { type CaptureBudget, NO_BUDGET } from '../encode/capture-budget.ts';
import { SourceRate } from '../sources/source-rate.ts';
import type { CaptureReport, CaptureRequest, ReportSink } from './capture-messages.ts';
import type { CapturePipeline } from './pipeline.ts';

/** Shortest interval between two reports of the state, ms: fewer wake-ups of both threads. */
const STATE_INTERVAL_MS = 20;
/**
 * An unchanged state is repeated at this interval, as a sign of life, ms. Chosen: 50 of them are missing when
 * the program ends (run.ts).
 */
const UNCHANGED_STATE_INTERVAL_MS = 100;
/**
 * Longest time between two calls for a source that is polled, ms. Chosen: requests to the thread wait no
 * longer, and an idle one wakes up 100 times a second.
 */
const MAX_WAIT_MS = 10;
/**
 * The obstacle guard gets a cloud at least this often if the source has that many, ms. A sensor is silent
 * after 400 ms.
 */
const LOOK_INTERVAL_MS = 50;
/**
 * A cloud from a source with its own timing is skipped if it has waited longer than this for an operator, ms.
 * Chosen: one and a half intervals at 30 a second, so that the next one is about to come.
 */
const MAX_READY_AGE_MS = 50;

export interface CaptureLoopOptions {
  /** The highest rate at which the source may be asked for clouds. */
  framesPerSecond: number;
  /** How many clouds there are to look at, per second, if the source knows. */
  sourceFramesPerSecond?: number | undefined;
  now: () => number;
  send: ReportSink;
}

/** The parts of {@link CapturePipeline} that the loop uses. */
export type LoopFrames = Pick<
  CapturePipeline,
  | 'capture'
  | 'close'
  | 'framesWithoutBuffer'
  | 'guard'
  | 'guarding'
  | 'hasRoom'
  | 'look'
  | 'recycle'
  | 'requestLatencyTest'
  | 'wishes'
>;

/**
 * Decides when clouds are captured. A source that can be asked at any time is asked at the plan's rate. A source with
 * its own timing offers its clouds, and the loop takes as many as the plan has room for. The owner calls {@link captureDue},
 * and calls it again after the number of ms that it returned.
 */
export class CaptureLoop {
  readonly #source: FrameSource;
  readonly #frames: LoopFrames;
  readonly #now: () => number;
  readonly #send: ReportSink;
  readonly #pace = new EvenPace();
  /** Of a source with its own timing; one that is asked comes when it is asked. */
  readonly #rate = new SourceRate();
  /** Time between two frames before the first plan, and as last planned, ms. */
  readonly #defaultIntervalMs: number;
  #plannedMs: number;
  #budget: CaptureBudget = NO_BUDGET;
  #nextFrameMs: number;
  /** When the obstacle guard needs its next cloud. */
  #nextLookMs = 0;
  readonly #lookIntervalMs: number;
  #nextStateMs = 0;
  #toldState: BaseState | null = null;
  #toldStateMs = 0;
  /** Since when a source with its own timing has had a cloud ready, ms; `null` if it has none. */
  #readySinceMs: number | null = null;
  #lastFault = '';
  #toldRings: readonly number[] | null = null;
  #closed = false;

  constructor(source: FrameSource, frames: LoopFrames, options: CaptureLoopOptions) {
    const { framesPerSecond, sourceFramesPerSecond = Number.POSITIVE_INFINITY, now, send } = options;
    this.#source = source;
    this.#frames = frames;
    this.#now = now;
    this.#send = send;
    this.#defaultIntervalMs = 1000 / framesPerSecond;
    this.#lookIntervalMs = Math.max(LOOK_INTERVAL_MS, 1000 / sourceFramesPerSecond);
    this.#nextFrameMs = now();
    this.#plannedMs = this.#defaultIntervalMs;
    if (this.#ownRhythm) {
      // A cloud may have arrived before there was a listener.
      this.#readySinceMs = now();
      source.onReady = () => {
        this.#readySinceMs = this.#now();
        this.#rate.came(this.#readySinceMs);
        this.#takeReady();
      };
    }
    if (source.onFault !== undefined) source.onFault = ({ message }) => this.#onFault(message);
    if (source.onVideo !== undefined)
      source.onVideo = (video, picture) => send({ type: 'video', video, picture }, [picture.bytes.buffer]);
    if (source.onTelemetry !== undefined)
      source.onTelemetry = (message) => send({ type: 'telemetry', message });
    if (source.onReading !== undefined) source.onReading = (reading) => send({ type: 'reading', reading });
  }

  get closed(): boolean {
    return this.#closed;
  }

  onRequest(request: Exclude<CaptureRequest, { type: 'pictures' }>): void {
    switch (request.type) {
      case 'budget':
        this.#budget = request;
        // A cloud may have been waiting for an operator.
        this.#takeReady();
        break;
      case 'guard':
        this.#frames.guard(request.wanted);
        this.#takeReady();
        break;
      case 'latencyTest':
        this.#frames.requestLatencyTest();
        break;
      case 'recycle':
        this.#frames.recycle(request.buffer);
        break;
      case 'watchVideo':
        this.#source.watchVideo?.(request.video, request.watched);
        // Its clouds may have been waiting for an operator.
        this.#takeReady();
        break;
      case 'close':
        this.#closed = true;
        this.#source.close();
        this.#frames.close();
        this.#send({ type: 'closed' });
        break;
    }
  }

  /** Captures and reports what is due. @returns when to call it again, ms from now */
  captureDue(): number {
    const now = this.#now();
    if (!this.#ownRhythm && now >= this.#nextFrameMs) this.#captureAtPlan();
    if (!this.#ownRhythm && this.#mustLook(now)) this.#look(now);
    if (now >= this.#nextStateMs) {
      this.#nextStateMs = now + STATE_INTERVAL_MS;
      this.#tellState(now);
      this.#tellRings();
    }
    const after = this.#now();
    // Timers cut off fractions: it would be called early, and once more.
    if (this.#ownRhythm) return Math.max(Math.ceil(this.#nextStateMs - after), 0);
    return Math.min(Math.max(Math.ceil(this.#nextFrameMs - after), 0), MAX_WAIT_MS);
  }

  /** Whether the source has its own timing: then {@link captureDue} only reports its state. */
  get #ownRhythm(): boolean {
    return this.#source.onReady !== undefined;
  }

  #captureAtPlan(): void {
    const beganMs = this.#now();
    const interval = (this.#budget.streaming ? this.#capture() : null) ?? this.#defaultIntervalMs;
    // After a stall the schedule restarts; missed frames are not made up for.
    const dueMs = beganMs - this.#nextFrameMs > interval ? beganMs : this.#nextFrameMs;
    this.#nextFrameMs = Math.max(dueMs + interval, this.#now());
  }

  /** Takes or skips the cloud that is ready. While nobody watches, the source keeps it. */
  #takeReady(): void {
    if (this.#readySinceMs === null || this.#closed) return;
    const now = this.#now();
    if (!this.#budget.streaming) {
      if (this.#source.goesOn !== true && !this.#frames.guarding) return;
      this.#readySinceMs = null;
      this.#pass(now);
      return;
    }
    const aged = now - this.#readySinceMs > MAX_READY_AGE_MS;
    this.#readySinceMs = null;
    if (aged || !this.#frames.hasRoom || !this.#pace.takes(now, this.#plannedMs)) {
      this.#pass(now);
      return;
    }
    const interval = this.#capture();
    if (interval === null) return;
    this.#plannedMs = interval;
    this.#pace.taken(now, interval);
  }

  /** A cloud that is not sent: the obstacle guard may need it. */
  #pass(now: number): void {
    if (this.#mustLook(now)) this.#look(now);
    else this.#source.skip?.(now, this.#frames.wishes(this.#budget));
  }

  #mustLook(now: number): boolean {
    return this.#frames.guarding && now >= this.#nextLookMs;
  }

  #look(now: number): void {
    this.#nextLookMs = now + this.#lookIntervalMs;
    this.#frames.look(this.#budget);
  }

  /** @returns the time until the next frame, ms; `null` if there was no cloud or no buffer */
  #capture(): number | null {
    const intervalMs = this.#frames.capture(this.#budget, this.#rate.perSecond);
    if (intervalMs !== null) {
      this.#lastFault = '';
      this.#nextLookMs = this.#now() + this.#lookIntervalMs;
    }
    return intervalMs;
  }

  #tellState(now: number): void {
    const { state } = this.#source;
    if (state === this.#toldState && now - this.#toldStateMs < UNCHANGED_STATE_INTERVAL_MS) return;
    this.#toldState = state;
    this.#toldStateMs = now;
    const { framesWithoutBuffer } = this.#frames;
    const report: CaptureReport = { type: 'state', state: { ...state, timeMs: now }, framesWithoutBuffer };
    this.#send(report);
  }

  #tellRings(): void {
    const { rings = null } = this.#source;
    if (rings === this.#toldRings || rings === null) return;
    this.#toldRings = rings;
    this.#send({ type: 'rings', elevations: rings });
  }

  /** Reports a repeated fault only once, until the source delivers a cloud again. */
  #onFault(detail: string): void {
    if (detail !== this.#lastFault) this.#send({ type: 'fault', detail });
    this.#lastFault = detail;
  }
}
