/** Counts what came between the operator and a drive, and for how long the robot was silent, from the page's events. Pure. */
import type { DetailOf, EventDetail } from '../events/page-event.ts';
import type { ReportInterventions } from './report-schema.ts';

/** The kinds of which each is only counted. */
const COUNTED = {
  held: 'held',
  slowed: 'slowed',
  blocked: 'blocked',
  watchdog: 'watchdog',
  'let-go-first': 'letGoFirst',
  'grip-lost': 'gripLost',
  alarm: 'alarms',
} as const satisfies Partial<Record<EventDetail['kind'], keyof ReportInterventions>>;

/** Names that are counted one by one. Chosen: more than a robot has operators; a robot says what names it likes. */
const MOST_NAMES = 32;

const STOPS = { you: 'stopsByYou', operator: 'stopsByOthers', robot: 'stopsByRobot' } as const;

export class InterventionCounts {
  readonly counts: Omit<ReportInterventions, 'heldS' | 'slowedS' | 'stopsByName'> = {
    stopsByYou: 0,
    stopsByOthers: 0,
    stopsByRobot: 0,
    held: 0,
    slowed: 0,
    blocked: 0,
    watchdog: 0,
    letGoFirst: 0,
    gripLost: 0,
    handovers: 0,
    takeovers: 0,
    alarms: 0,
    commandsRefused: {},
  };
  /** STOPs of others by name. */
  readonly stopsByName = new Map<string, number>();
  rateFalls = 0;
  outages = 0;
  outageMs = 0;
  longestOutageMs = 0;
  /** For how long this operator has had the drive, ms, up to the last change. */
  #leaseMs = 0;
  #leaseSinceMs: number | null = null;
  #silentSinceMs: number | null = null;
  #driver: string | null = null;
  #wasYours = false;
  /** Changes from this operator to another or back; those that both have agreed to are no take-overs. */
  #passed = 0;

  /** @param nowMs page's clock @param times how often it has happened */
  observe(detail: EventDetail, nowMs: number, times: number): void {
    const { counts } = this;
    switch (detail.kind) {
      case 'stop':
        if (!detail.already) this.#onStop(detail);
        return;
      case 'command-refused':
        counts.commandsRefused[detail.reason] = (counts.commandsRefused[detail.reason] ?? 0) + times;
        return;
      case 'lease':
        this.#onLease(detail.holder, `${detail.holder} ${detail.driver}`, nowMs);
        return;
      case 'handover':
        if (detail.ended === 'accepted') counts.handovers++;
        return;
      case 'rate-fell':
        this.rateFalls++;
        return;
      case 'robot-silent':
        this.#silentSinceMs = nowMs;
        this.outages++;
        return;
      case 'robot-heard':
        this.#silentSinceMs = null;
        this.#addOutage(detail.silentMs);
        return;
      default:
        if (detail.kind in COUNTED) counts[COUNTED[detail.kind as keyof typeof COUNTED]]++;
    }
  }

  /** The session is over: what lasts, ends. @param nowMs page's clock */
  end(nowMs: number): void {
    if (this.#silentSinceMs !== null) this.#addOutage(nowMs - this.#silentSinceMs);
    this.#silentSinceMs = null;
    this.#onLease('nobody', '', nowMs);
  }

  leaseMs(nowMs: number): number {
    return this.#leaseMs + (this.#leaseSinceMs === null ? 0 : nowMs - this.#leaseSinceMs);
  }

  get takeovers(): number {
    return Math.max(0, this.#passed - this.counts.handovers);
  }

  #onStop({ by, name }: DetailOf<'stop'>): void {
    this.counts[STOPS[by]]++;
    const { stopsByName } = this;
    if (by !== 'operator' || name === '') return;
    if (stopsByName.has(name) || stopsByName.size < MOST_NAMES)
      stopsByName.set(name, (stopsByName.get(name) ?? 0) + 1);
  }

  #onLease(holder: 'you' | 'other' | 'nobody', driver: string, nowMs: number): void {
    this.#leaseMs = this.leaseMs(nowMs);
    this.#leaseSinceMs = holder === 'you' ? nowMs : null;
    const now = holder === 'nobody' ? null : driver;
    const [before, isYours] = [this.#driver, holder === 'you' || this.#wasYours];
    // What others agree among themselves, this page is not told.
    if (now !== null && before !== null && now !== before && isYours) this.#passed++;
    this.#driver = now;
    this.#wasYours = holder === 'you';
  }

  #addOutage(ms: number): void {
    this.outageMs += ms;
    this.longestOutageMs = Math.max(this.longestOutageMs, ms);
  }
}
