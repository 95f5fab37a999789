/** A frame to send: `packets` packets, `bytes` in all on the wire, all but the last of one size. */
export interface PacedFrame {
  packets: number;
  bytes: number;
  /** Spread over at least this long, ms, even where the rate allows less; 0 for as fast as the rate allows. */
  minSpanMs?: number;
  /** Begun this long ago, ms, it gives way to a newer frame; the pacer's `maxFrameMs` where absent. */
  maxSpanMs?: number;
}

/** Why a frame, or the rest of it, is not sent. */
export type FrameDropReason =
  | 'superseded' // a newer frame came before this one was begun
  | 'overdue' // begun, but a newer frame waits and this one has taken too long
  | 'cleared'; // the stream was stopped

export interface DroppedFrame<T extends PacedFrame> {
  frame: T;
  reason: FrameDropReason;
  /** How many of its packets were not sent. */
  packets: number;
}

/** Packets `first` … `first + count − 1` of `frame` may go now. */
export interface PacedRun<T extends PacedFrame> {
  frame: T;
  first: number;
  count: number;
  /** The frame's last packet is among them. */
  last: boolean;
}

export interface PacerOptions {
  /** Frames that may wait to be begun, at least 1. */
  maxWaitingFrames?: number;
  /** Rate of sending over the target rate, 1.0–1.25: a little faster, so that a frame is over before the next comes. */
  factor?: number;
  /** Packets may go this much before their time, ms: fewer wake-ups, small bursts. */
  burstMs?: number;
  /** A late wake-up makes up for at most this much, ms; what is later moves the schedule. */
  catchUpMs?: number;
  /** A frame begun this long ago gives way to a newer one, ms. */
  maxFrameMs?: number;
}

/**
 * A lower rate is taken for this one, bit/s: a packet every 0.1 s, so that a rate that rises again is noticed soon. Who
 * wants to send nothing stops the stream.
 */
const MIN_BITS_PER_SECOND = 100_000;

/**
 * Says when the packets of frames may go, evenly over time instead of in one burst per frame. It owns no timer and no
 * packet: ask `due` until it has nothing more, then again at `nextDueMs`.
 */
export class PacketPacer<T extends PacedFrame> {
  readonly #options: Required<PacerOptions>;
  readonly #waiting: { frame: T; sinceMs: number }[] = [];
  readonly #drops: Record<FrameDropReason, number> = { superseded: 0, overdue: 0, cleared: 0 };
  #bitsPerSecond: number;
  #current: { frame: T; sent: number; startMs: number } | null = null;
  /** Before this time the next packet must not go. */
  #nextMs = Number.NEGATIVE_INFINITY;

  constructor(bitsPerSecond: number, options: PacerOptions = {}) {
    this.#options = {
      maxWaitingFrames: options.maxWaitingFrames ?? 1,
      factor: options.factor ?? 1.1,
      burstMs: options.burstMs ?? 1,
      catchUpMs: options.catchUpMs ?? 10,
      maxFrameMs: options.maxFrameMs ?? 250,
    };
    this.#bitsPerSecond = Math.max(bitsPerSecond, MIN_BITS_PER_SECOND);
  }

  /** How many frames were dropped, wholly or in part, by reason. */
  get drops(): Readonly<Record<FrameDropReason, number>> {
    return this.#drops;
  }

  /** @param bitsPerSecond what the rate controller allows, before the factor */
  setRate(bitsPerSecond: number): void {
    this.#bitsPerSecond = Math.max(bitsPerSecond, MIN_BITS_PER_SECOND);
  }

  /** Takes a frame over. @returns the frames that have to give way to it */
  enqueue(frame: T, nowMs: number): DroppedFrame<T>[] {
    const dropped: DroppedFrame<T>[] = [];
    const current = this.#current;
    const maxSpanMs = current?.frame.maxSpanMs ?? this.#options.maxFrameMs;
    if (current !== null && nowMs - current.startMs >= maxSpanMs) {
      dropped.push(this.#dropped(current.frame, 'overdue', current.frame.packets - current.sent));
      this.#current = null;
    }
    this.#waiting.push({ frame, sinceMs: nowMs });
    while (this.#waiting.length > this.#options.maxWaitingFrames) {
      const oldest = (this.#waiting.shift() as { frame: T }).frame;
      dropped.push(this.#dropped(oldest, 'superseded', oldest.packets));
    }
    return dropped;
  }

  /** Drops everything, as when the stream stops. */
  clear(): DroppedFrame<T>[] {
    const dropped: DroppedFrame<T>[] = [];
    if (this.#current !== null) {
      const { frame, sent } = this.#current;
      dropped.push(this.#dropped(frame, 'cleared', frame.packets - sent));
      this.#current = null;
    }
    for (const { frame } of this.#waiting.splice(0))
      dropped.push(this.#dropped(frame, 'cleared', frame.packets));
    return dropped;
  }

  /** When `due` has something next, maybe past; `null` where nothing waits. */
  get nextDueMs(): number | null {
    if (this.#current !== null) return this.#nextMs;
    const next = this.#waiting[0];
    // What was not sent while there was nothing to send is not made up for.
    return next === undefined ? null : Math.max(this.#nextMs, next.sinceMs);
  }

  /** The packets that may go now, of one frame; `null` where none may. Ask again until `null`. */
  due(nowMs: number): PacedRun<T> | null {
    const dueMs = this.nextDueMs;
    if (dueMs === null || dueMs > nowMs) return null;
    const current = this.#current ?? this.#begin(nowMs);
    this.#nextMs = Math.max(dueMs, nowMs - this.#options.catchUpMs);
    const { frame } = current;
    const spacingMs = this.#spacingMs(frame);
    const first = current.sent;
    const until = nowMs + this.#options.burstMs;
    let count = 0;
    while (first + count < frame.packets && (count === 0 || this.#nextMs < until)) {
      count++;
      this.#nextMs += spacingMs;
    }
    current.sent += count;
    const last = current.sent === frame.packets;
    if (last) this.#current = null;
    return { frame, first, count, last };
  }

  #begin(nowMs: number): { frame: T; sent: number; startMs: number } {
    const { frame } = this.#waiting.shift() as { frame: T };
    this.#current = { frame, sent: 0, startMs: nowMs };
    return this.#current;
  }

  #spacingMs(frame: T): number {
    const { factor } = this.#options;
    const bits = frame.bytes * 8;
    const atRateMs = (bits / (this.#bitsPerSecond * factor)) * 1000;
    return Math.max(atRateMs, frame.minSpanMs ?? 0) / frame.packets;
  }

  #dropped(frame: T, reason: FrameDropReason, packets: number): DroppedFrame<T> {
    this.#drops[reason]++;
    return { frame, reason, packets };
  }
}
