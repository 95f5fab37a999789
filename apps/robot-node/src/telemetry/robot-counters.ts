import type { ReadyFrame } from '../capture/capture-messages.ts';

/** Counts by a typed reason. */
export class ReasonCounts {
  readonly #counts = new Map<string, number>();

  add(reason: string, by = 1): void {
    this.#counts.set(reason, (this.#counts.get(reason) ?? 0) + by);
  }

  entries(): Iterable<[string, number]> {
    return this.#counts.entries();
  }

  get(reason: string): number {
    return this.#counts.get(reason) ?? 0;
  }
}

/** Everything the robot counts that belongs to no single operator; sums since the start. */
export class RobotCounters {
  sessionsOpened = 0;
  sessionsRefused = 0;
  readonly sessionsEnded = new ReasonCounts();
  /** Offered to operators that had lost their path. */
  iceRestarts = 0;
  /** Requests to resume a session, by the reason they were refused for. */
  readonly resumesRefused = new ReasonCounts();
  /** Answers that changed nothing: repeated, or asked for by nobody. */
  readonly answersIgnored = new ReasonCounts();
  readonly candidatesRefused = new ReasonCounts();
  /** What came to the sockets of sessions and was dropped unread, by reason. */
  readonly datagramsRefused = new ReasonCounts();
  readonly signalingErrors = new ReasonCounts();
  commandsAccepted = 0;
  readonly commandsRejected = new ReasonCounts();
  /** By channel and error code. */
  readonly messagesRefused = new ReasonCounts();
  framesCaptured = 0;
  /** Captured, but too old when they came out of the worker. */
  framesStale = 0;
  pointsCaptured = 0;
  /** Points not sent, by reason. */
  readonly pointsRejected = new ReasonCounts();
  /** Seconds of work by stage; for the source's own work, and for sending, processor time. */
  readonly stageSeconds = new ReasonCounts();
  /** Of the last frame. */
  lastPoints = 0;
  lastFramesPerSecond = 0;
  lastValidPoints = 0;

  frame(frame: ReadyFrame): void {
    this.framesCaptured++;
    this.pointsCaptured += frame.points;
    this.lastPoints = frame.points;
    this.lastFramesPerSecond = 1000 / frame.intervalMs;
    this.lastValidPoints = frame.validPoints;
    const { notFinite, nonPositiveDepth, outOfRange, notDrawn } = frame.rejected;
    this.pointsRejected.add('notFinite', notFinite);
    this.pointsRejected.add('nonPositiveDepth', nonPositiveDepth);
    this.pointsRejected.add('outOfRange', outOfRange);
    this.pointsRejected.add('notDrawn', notDrawn);
    this.stageSeconds.add('capture', frame.captureCpuMs / 1000);
    this.stageSeconds.add('sample', frame.sampleMs / 1000);
    this.stageSeconds.add('pack', frame.packMs / 1000);
  }
}
