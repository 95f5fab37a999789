/** Finds in the robot's telemetry what the event log tells of: that it is held, slowed, stopped or sent less. Pure. */
import type { Telemetry } from '@farpoint/protocol';
import type { EventDetail } from '../../ground/events/page-event.ts';

/**
 * A limit that comes and goes is over once nothing has limited the robot for so long, ms of its clock. Chosen: reasons such as a
 * late view change several times a second; motion-events.test.ts holds it.
 */
const FREE_AFTER_MS = 1000;
/** A bit rate that has fallen to this share of what it was, and one that is back. Chosen: half is seen; motion-events.test.ts holds both. */
const FALLEN_SHARE = 0.5;
const BACK_SHARE = 0.8;
/** How fast the rate that a fall is measured by follows a lower one, 1/s. Chosen: a slow decline over half a minute is no fall. */
const FORGET_PER_S = 0.05;

type Limit = 'free' | 'slowed' | 'held';

/** Follows the telemetry of one session. */
export class MotionEvents {
  #limit: Limit = 'free';
  #strictest: string | undefined;
  #limitedMs = Number.NEGATIVE_INFINITY;
  #drive: Telemetry['drive'] | null = null;
  #letsGoFirst = false;
  #guard: string | undefined;
  #timeMs: number | null = null;
  /** The bit rate that a fall is measured by; what it was before the fall while it is low. */
  #usual = 0;
  #isLow = false;

  /** @returns what is new */
  observe(telemetry: Telemetry): EventDetail[] {
    const { timeMs } = telemetry;
    // Telemetry may come out of order.
    if (this.#timeMs !== null && timeMs <= this.#timeMs) return [];
    const found: EventDetail[] = [];
    this.#observeLimit(telemetry, found);
    this.#observeDrive(telemetry, found);
    this.#observeRate(telemetry, found);
    this.#timeMs = timeMs;
    return found;
  }

  #observeLimit({ motion, timeMs }: Telemetry, found: EventDetail[]): void {
    const reasons = [...(motion?.reasons ?? [])];
    const limit: Limit = reasons.length === 0 ? 'free' : motion?.factor === 0 ? 'held' : 'slowed';
    if (limit === 'free') {
      if (this.#limit === 'free' || timeMs - this.#limitedMs < FREE_AFTER_MS) return;
      found.push({ kind: 'free' });
      this.#limit = 'free';
      return;
    }
    this.#limitedMs = timeMs;
    if (limit === this.#limit && reasons[0] === this.#strictest) return;
    this.#limit = limit;
    this.#strictest = reasons[0];
    found.push({ kind: limit, reasons });
  }

  #observeDrive({ drive, motion }: Telemetry, found: EventDetail[]): void {
    if (drive !== this.#drive) {
      if (drive === 'watchdog') found.push({ kind: 'watchdog' });
      // What holds it says more.
      if (drive === 'blocked' && (motion?.reasons.length ?? 0) === 0) found.push({ kind: 'blocked' });
      this.#drive = drive;
    }
    const letsGoFirst = motion?.letGoFirst === true;
    if (letsGoFirst && !this.#letsGoFirst) found.push({ kind: 'let-go-first' });
    this.#letsGoFirst = letsGoFirst;
    const state = motion?.obstacleGuard;
    // A guard that is on from the start is as it should be.
    const isNews = state !== this.#guard && (this.#guard !== undefined || state !== 'on');
    if (state !== undefined && isNews) found.push({ kind: 'guard-state', state });
    this.#guard = state;
  }

  #observeRate({ stream, timeMs }: Telemetry, found: EventDetail[]): void {
    const rate = stream.targetBitsPerSecond;
    const kbps = (bitsPerSecond: number) => Math.round(bitsPerSecond / 1000);
    if (this.#isLow) {
      if (rate < BACK_SHARE * this.#usual) return;
      this.#isLow = false;
      this.#usual = rate;
      found.push({ kind: 'rate-recovered', toKbps: kbps(rate) });
    } else if (rate < FALLEN_SHARE * this.#usual) {
      this.#isLow = true;
      found.push({ kind: 'rate-fell', fromKbps: kbps(this.#usual), toKbps: kbps(rate) });
    } else {
      const seconds = this.#timeMs === null ? 0 : (timeMs - this.#timeMs) / 1000;
      const forgotten = this.#usual + (rate - this.#usual) * Math.min(1, FORGET_PER_S * seconds);
      this.#usual = Math.max(rate, forgotten);
    }
  }
}
