/** What is counted of each cloud. */
export interface CountedFrame {
  points: number;
  validPoints: number;
  /** Until the next one, ms. */
  intervalMs: number;
  /** Points not sent, by reason. */
  rejected: Readonly<Record<'notFinite' | 'nonPositiveDepth' | 'outOfRange' | 'notDrawn', number>>;
  captureCpuMs: number;
  sampleMs: number;
  packMs: number;
}

/** Counts by typed reason. */
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

/** Everything that the robot counts and that does not belong to a single operator; totals since the start. */
export class RobotCounters {
  sessionsOpened = 0;
  sessionsRefused = 0;
  readonly sessionsEnded = new ReasonCounts();
  /** ICE restarts offered to operators that had lost their path. */
  iceRestarts = 0;
  /** Refused requests to resume a session, by reason. */
  readonly resumesRefused = new ReasonCounts();
  /** Operators that were not admitted, by the fault of their grant or proof. */
  readonly grantsRefused = new ReasonCounts();
  /** Lists of revoked grants that arrived, by what became of them. */
  readonly revocationLists = new ReasonCounts();
  /** Answers that changed nothing, because they were repeated or no offer waited for them. */
  readonly answersIgnored = new ReasonCounts();
  readonly candidatesRefused = new ReasonCounts();
  /** Datagrams that arrived on sessions' sockets and were dropped unread, by reason. */
  readonly datagramsRefused = new ReasonCounts();
  readonly signalingErrors = new ReasonCounts();
  commandsAccepted = 0;
  readonly commandsRejected = new ReasonCounts();
  /** Times that something began to bound the robot's motion. */
  readonly interventions = new ReasonCounts();
  /** By channel and error code. */
  readonly messagesRefused = new ReasonCounts();
  /** Ends of requests for the drive and offers of it: `ask-refused`, `offer-accepted` and so on. */
  readonly handovers = new ReasonCounts();
  /** Commands that were begun, by id. */
  readonly commandCalls = new ReasonCounts();
  /** What became of commands: how they ended, or why they were refused. */
  readonly commandOutcomes = new ReasonCounts();
  framesCaptured = 0;
  /** Frames that were captured, but too old when they left the worker. */
  framesStale = 0;
  /** Points not sent, by reason. */
  readonly pointsRejected = new ReasonCounts();
  /** Seconds of work by stage. For the source's own work and for sending, this is processor time. */
  readonly stageSeconds = new ReasonCounts();
  /** Points in the last frame. */
  lastPoints = 0;
  lastFramesPerSecond = 0;
  lastValidPoints = 0;

  frame(frame: CountedFrame): void {
    this.framesCaptured++;
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
