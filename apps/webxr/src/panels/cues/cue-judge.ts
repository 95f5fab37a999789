/** When the operator should hear and feel that the robot does less than it is told. */
import type { DriveState, Intervention, MotionState } from '@farpoint/protocol';

export const cues = [
  'slower', // the robot begins to go more slowly than it is told
  'held', // it stops, or does not start, although it is told to go
  'stop', // the emergency stop has been latched, by whomever
] as const;
export type Cue = (typeof cues)[number];

/** What the robot says, and whether this operator drives it. */
export interface DrivenState {
  /** The operator's grip is held and drives. */
  driving: boolean;
  latched: boolean;
  drive: DriveState;
  motion: MotionState | undefined;
}

/** These hold for minutes in ordinary driving, and the screen says them. */
const LASTING: ReadonlySet<Intervention> = new Set(['blind-travel', 'unseen-space', 'sensor-silent']);
/**
 * A reason that comes and goes, as it does at the edge of a zone, is told once within this time, ms. Chosen:
 * shorter, cues become noise; longer, a second cause is not heard. cue-judge.test.ts holds it.
 */
const QUIET_MS = 1500;

/** Pure: time is an argument. */
export class CueJudge {
  #before: { cue: Cue | null; reason: Intervention | null } = { cue: null, reason: null };
  #latched = true;
  /** When each was told last, page's clock, ms. */
  readonly #toldMs = new Map<string, number>();

  /** @returns what begins now; `null` if nothing does */
  next(state: DrivenState, nowMs: number): Cue | null {
    const stops = state.latched && !this.#latched;
    this.#latched = state.latched;
    const now = lessThanTold(state);
    const before = this.#before;
    this.#before = now;
    if (stops) return this.#tell('stop', null, nowMs);
    // What the stop has already said.
    if (now.cue === null || state.latched) return null;
    const begins = now.cue !== before.cue || now.reason !== before.reason;
    // Held before, and now only slower: that is better, and no reason to be told anything.
    const eases = before.cue === 'held' && now.cue === 'slower';
    return begins && !eases ? this.#tell(now.cue, now.reason, nowMs) : null;
  }

  #tell(cue: Cue, reason: Intervention | null, nowMs: number): Cue | null {
    const key = `${cue} ${reason}`;
    const told = this.#toldMs.get(key) ?? Number.NEGATIVE_INFINITY;
    if (cue !== 'stop' && nowMs - told < QUIET_MS) return null;
    this.#toldMs.set(key, nowMs);
    return cue;
  }
}

function lessThanTold({ driving, drive, motion }: DrivenState): {
  cue: Cue | null;
  reason: Intervention | null;
} {
  if (!driving) return { cue: null, reason: null };
  if (drive === 'watchdog') return { cue: 'held', reason: null };
  const reason = motion?.reasons[0] ?? null;
  if (motion === undefined || reason === null) return { cue: null, reason: null };
  if (motion.factor === 0) return { cue: 'held', reason };
  return LASTING.has(reason) ? { cue: null, reason } : { cue: 'slower', reason };
}
