/** Who else is at the robot, and what they ask of each other. Takes messages and the time; pure. */
import type { Handover, Operators } from '@farpoint/protocol';

/** A request for the drive or an offer of it that can be answered or taken back. */
export interface OpenHandover extends Omit<Handover, 'type' | 'leftMs' | 'ended'> {
  /** Until when, `performance.now()`. */
  readonly endsAtMs: number;
}

/** More than a robot lets its operators have open: each has one. */
const MOST_OPEN = 64;

/** What the robot has told about its operators' dealings with each other in this session. */
export class RobotPeople {
  /** Since when the one who drives has driven, `performance.now()`; `null` if nobody drives or nobody knows. */
  drivesSinceMs: number | null = null;
  readonly #open = new Map<number, OpenHandover>();

  /**
   * The requests and offers that can be answered or taken back, the oldest first.
   *
   * @param nowMs `performance.now()`
   */
  open(nowMs: number): readonly OpenHandover[] {
    // The robot says when they end, but may not be heard.
    return [...this.#open.values()].filter(({ endsAtMs }) => nowMs < endsAtMs);
  }

  /** The robot has said who is here. */
  onOperators({ drivesForS }: Operators, nowMs: number): void {
    this.drivesSinceMs = drivesForS === undefined ? null : nowMs - drivesForS * 1000;
  }

  /** A request or an offer was made, or has ended. */
  onHandover({ id, kind, from, to, yours, leftMs }: Handover, nowMs: number): void {
    this.#open.delete(id);
    for (const [old, { endsAtMs }] of this.#open) if (nowMs >= endsAtMs) this.#open.delete(old);
    if (leftMs !== undefined && this.#open.size < MOST_OPEN)
      this.#open.set(id, { id, kind, from, to, yours, endsAtMs: nowMs + leftMs });
  }
}

/** Whether the operator that gets the message drives from now on. */
export function givesYou({ kind, yours, ended }: Handover): boolean {
  return ended === 'accepted' && (kind === 'ask') === yours;
}
