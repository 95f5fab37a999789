/** Who else is at the robot: what they ask of each other, and what they say. Takes messages and the time; pure. */
import {
  type ChatLine,
  type Handover,
  KEPT_CHAT_LINES,
  type NamedOperator,
  type Operators,
} from '@farpoint/protocol';

/** A request for the drive or an offer of it that can be answered or taken back. */
export interface OpenHandover extends Omit<Handover, 'type' | 'leftMs' | 'ended'> {
  /** Until when, `performance.now()`. */
  readonly endsAtMs: number;
}

/** A line of chat. */
export interface HeardLine {
  /** The robot's number of the line. */
  readonly number: number;
  /** Who said it. */
  readonly from: NamedOperator;
  /** Whether this operator said it, in this session. */
  readonly yours: boolean;
  /** Text, never markup. */
  readonly text: string;
  /** When it was said, `performance.now()`. */
  readonly saidAtMs: number;
}

/** What the robot has told about its operators' dealings with each other in this session. */
export class RobotPeople {
  /** Since when the one who drives has driven, `performance.now()`; `null` if nobody drives or nobody knows. */
  drivesSinceMs: number | null = null;
  readonly #open = new Map<number, OpenHandover>();
  #lines: readonly HeardLine[] = [];

  /** The last lines of chat, the oldest first; the same array while there is no new one. */
  get lines(): readonly HeardLine[] {
    return this.#lines;
  }

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
    if (leftMs === undefined) this.#open.delete(id);
    else this.#open.set(id, { id, kind, from, to, yours, endsAtMs: nowMs + leftMs });
  }

  /** A line was said. */
  onChatLine({ number, from, yours, text, agoS }: ChatLine, nowMs: number): void {
    const line = { number, from, yours, text, saidAtMs: nowMs - agoS * 1000 };
    this.#lines = [...this.#lines.slice(1 - KEPT_CHAT_LINES), line];
  }
}

/** Whether the operator that gets the message drives from now on. */
export function givesYou({ kind, yours, ended }: Handover): boolean {
  return ended === 'accepted' && (kind === 'ask') === yours;
}
