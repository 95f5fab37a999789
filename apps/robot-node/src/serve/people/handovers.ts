import { type FaultReason, HANDOVER_MS, type HandoverEnd, type HandoverKind } from '@farpoint/protocol';

/** After a refusal the same operator waits for this long before it asks or offers again, ms. Chosen: a driver who refuses is left alone for a while. */
export const REFUSED_MS = 10_000;

/** Who drives, and whether anybody may. */
export interface DriveFacts {
  /** The session that holds the lease. */
  readonly driver: string | null;
  /** The lease itself: another one after each change. */
  readonly lease: string | null;
  readonly latched: boolean;
  /** Number of the emergency stop's latest latch. */
  readonly latch: number | undefined;
}

/** A request or an offer that can be answered. */
export interface OpenHandover {
  readonly id: number;
  readonly kind: HandoverKind;
  /** The session that made it. */
  readonly from: string;
  /** The session that answers it. */
  readonly to: string;
  readonly endsMs: number;
}

export interface HandoversPort {
  facts(): DriveFacts;
  /** Whether the session's operator may drive; `null` if there is no such session, or it is not connected. */
  mayDrive(session: string): boolean | null;
  /** Moves the lease. @returns false if `from` does not hold it */
  handOver(from: string, to: string): boolean;
  /** It was made, or it has ended. @param end `null`: it was made */
  changed(handover: OpenHandover, end: HandoverEnd | null): void;
}

interface Made extends OpenHandover {
  readonly lease: string | null;
  readonly latch: number | undefined;
}

/**
 * Requests for the drive and offers of it. The lease moves only if the other operator agrees in time, and only from the
 * operator who has held it, under the same lease, since before the request or offer was made. Whatever the robot learns
 * in between ends it: another driver, somebody who leaves, STOP. Each operator has one at a time. Pure: time is an argument.
 */
export class Handovers {
  readonly #port: HandoversPort;
  readonly #open = new Map<number, Made>();
  /** Until when each refused operator waits. */
  readonly #waits = new Map<string, number>();
  #lastId = 0;

  constructor(port: HandoversPort) {
    this.#port = port;
  }

  /** Those that can be answered, the oldest first. */
  get open(): readonly OpenHandover[] {
    return [...this.#open.values()];
  }

  /** An operator asks who drives for the drive. @returns why not; `null`: it was asked */
  ask(by: string, nowMs: number): FaultReason | null {
    this.endDue(nowMs);
    const { driver } = this.#port.facts();
    if (this.#port.mayDrive(by) !== true) return 'not-permitted';
    if (driver === null) return 'nobody-drives';
    if (driver === by) return 'own-session';
    return this.#make('ask', by, driver, nowMs);
  }

  /** Who drives offers the drive to another. @returns why not; `null`: it was offered */
  offer(by: string, to: string, nowMs: number): FaultReason | null {
    this.endDue(nowMs);
    if (this.#port.facts().driver !== by) return 'not-driver';
    if (to === by) return 'own-session';
    return this.#make('offer', by, to, nowMs);
  }

  /** @returns why it is no answer; `null`: it is one */
  answer(by: string, id: number, accept: boolean, nowMs: number): FaultReason | null {
    this.endDue(nowMs);
    const made = this.#open.get(id);
    if (made === undefined || made.to !== by) return 'not-open';
    if (!accept) {
      this.#waits.set(made.from, nowMs + REFUSED_MS);
      this.#end(made, 'refused');
      return null;
    }
    const [giver, taker] = made.kind === 'offer' ? [made.from, made.to] : [made.to, made.from];
    this.#end(made, this.#port.handOver(giver, taker) ? 'accepted' : 'driver-changed');
    // Those that were meant for the driver until now.
    this.endDue(nowMs);
    return null;
  }

  /** @returns why it cannot be taken back; `null`: it was */
  withdraw(by: string, id: number, nowMs: number): FaultReason | null {
    this.endDue(nowMs);
    const made = this.#open.get(id);
    if (made === undefined || made.from !== by) return 'not-open';
    this.#end(made, 'withdrawn');
    return null;
  }

  /** Ends those that can no longer be answered. Call this every 25 ms. */
  endDue(nowMs: number): void {
    if (this.#open.size === 0) return;
    const facts = this.#port.facts();
    for (const made of [...this.#open.values()]) {
      const end = this.#endOf(made, facts, nowMs);
      if (end !== null) this.#end(made, end);
    }
  }

  /** The session has ended. */
  gone(session: string, nowMs: number): void {
    this.#waits.delete(session);
    this.endDue(nowMs);
  }

  #make(kind: HandoverKind, from: string, to: string, nowMs: number): FaultReason | null {
    const { lease, latch, latched } = this.#port.facts();
    const mayAnswer = this.#port.mayDrive(to);
    if (mayAnswer === null) return 'unknown-operator';
    if (!mayAnswer) return 'only-watches';
    if (latched) return 'estop';
    for (const made of this.#open.values()) if (made.from === from) return 'already-open';
    if (nowMs < (this.#waits.get(from) ?? nowMs)) return 'rate-limited';
    this.#lastId = (this.#lastId + 1) >>> 0;
    const made = { id: this.#lastId, kind, from, to, endsMs: nowMs + HANDOVER_MS, lease, latch };
    this.#open.set(made.id, made);
    this.#port.changed(made, null);
    return null;
  }

  #endOf(made: Made, { lease, latched, latch }: DriveFacts, nowMs: number): HandoverEnd | null {
    const { mayDrive } = this.#port;
    if (mayDrive(made.from) !== true || mayDrive(made.to) !== true) return 'left';
    // Also a latch that was released again meanwhile.
    if (latched || latch !== made.latch) return 'estop';
    if (lease !== made.lease) return 'driver-changed';
    return nowMs < made.endsMs ? null : 'expired';
  }

  #end(made: Made, end: HandoverEnd): void {
    this.#open.delete(made.id);
    this.#port.changed(made, end);
  }
}
