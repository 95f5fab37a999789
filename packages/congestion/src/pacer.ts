import { BitRate } from '@farpoint/timing';

/** A frame to send: `packets` packets with `bytes` in total on the wire. All packets but the last have equal size. */
export interface PacedFrame {
  packets: number;
  bytes: number;
  /**
   * The frame is spread over at least this long, ms, even if the rate allows less; 0 for as fast as the rate allows it.
   */
  minSpanMs?: number;
  /** In progress for this long, ms, the frame gives way to a newer one; the pacer's `maxFrameMs` if absent. */
  maxSpanMs?: number;
  /** The receiver can use the frame only with the one before it in its lane. */
  needsPrevious?: boolean;
  /** How many frames of its lane may wait to be begun; the pacer's `maxWaitingFrames` if absent. */
  maxWaitingFrames?: number;
  /** Lower lanes go first; 0 if absent. */
  lane?: number;
}

/** Why a frame, or the rest of it, is not sent. */
export type FrameDropReason =
  | 'superseded' // a newer frame came before this one was begun
  | 'overdue' // begun, but it has taken too long and a newer frame is waiting
  | 'undecodable' // a frame that this one needs was dropped
  | 'cleared'; // the stream was stopped

export interface DroppedFrame<T extends PacedFrame> {
  frame: T;
  reason: FrameDropReason;
  /** How many of the frame's packets were not sent. */
  packets: number;
}

/** Packets `first` … `first + count − 1` of `frame` may be sent now. */
export interface PacedRun<T extends PacedFrame> {
  frame: T;
  first: number;
  count: number;
  /** Whether the frame's last packet is among them. */
  last: boolean;
}

export interface PacerOptions {
  /** How many frames may wait to be begun, at least 1. */
  maxWaitingFrames?: number;
  /**
   * Sending rate as a multiple of the target rate, 1.0–1.25: slightly faster, so that a frame ends before the next one
   * comes.
   */
  factor?: number;
  /** Packets may be sent this much early, ms: fewer wake-ups, small bursts. */
  burstMs?: number;
  /**
   * But no more bytes than this, and after a late wake-up no more than this is caught up: receivers and switches take
   * only so much at once.
   */
  burstBytes?: number;
  /** After a late wake-up, at most this much is caught up, ms; beyond that the schedule moves. */
  catchUpMs?: number;
  /** A frame that has been in progress for this long gives way to a newer one, ms. */
  maxFrameMs?: number;
}

/**
 * Lower rates are raised to this one, bit/s. A packet every 0.1 s lets the pacer notice soon when the rate rises again.
 * To send nothing, stop the stream.
 */
const MIN_BITS_PER_SECOND = 100_000;

/** A frame whose sending has begun. */
interface Sending<T> {
  frame: T;
  sent: number;
  startMs: number;
}

/** The frames of one source. */
interface Lane<T> {
  number: number;
  waiting: { frame: T; sinceMs: number }[];
  current: Sending<T> | null;
}

/**
 * Schedules the packets of frames evenly over time instead of in one burst per frame. It owns no timer and no packet:
 * call `due` until it returns nothing, then again at `nextDueMs`. Each source has a lane of its own: a frame gives way
 * only to newer frames of its own lane, and the packets of lower lanes go first.
 */
export class PacketPacer<T extends PacedFrame> {
  readonly #options: Required<PacerOptions>;
  /** In order of lane number. */
  readonly #lanes: Lane<T>[] = [];
  readonly #drops: Record<FrameDropReason, number> = {
    superseded: 0,
    overdue: 0,
    undecodable: 0,
    cleared: 0,
  };
  #bitsPerSecond: number;
  /** The next packet must not be sent before this time. */
  #nextMs = Number.NEGATIVE_INFINITY;

  constructor(bitsPerSecond: number, options: PacerOptions = {}) {
    this.#options = {
      maxWaitingFrames: options.maxWaitingFrames ?? 1,
      factor: options.factor ?? 1.1,
      burstMs: options.burstMs ?? 1,
      burstBytes: options.burstBytes ?? Number.POSITIVE_INFINITY,
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

  /** Takes over a frame. @returns the frames that are dropped for it */
  enqueue(frame: T, nowMs: number): DroppedFrame<T>[] {
    const dropped: DroppedFrame<T>[] = [];
    const lane = this.#laneOf(frame);
    const { current, waiting } = lane;
    const maxSpanMs = current?.frame.maxSpanMs ?? this.#options.maxFrameMs;
    if (current !== null && nowMs - current.startMs >= maxSpanMs) {
      dropped.push(this.#dropped(current.frame, 'overdue', current.frame.packets - current.sent));
      lane.current = null;
    }
    waiting.push({ frame, sinceMs: nowMs });
    const most = frame.maxWaitingFrames ?? this.#options.maxWaitingFrames;
    while (waiting.length > most) {
      const oldest = (waiting.shift() as { frame: T }).frame;
      dropped.push(this.#dropped(oldest, 'superseded', oldest.packets));
    }
    if (dropped.length > 0) {
      for (let next = waiting[0]; next?.frame.needsPrevious === true; next = waiting[0]) {
        waiting.shift();
        dropped.push(this.#dropped(next.frame, 'undecodable', next.frame.packets));
      }
    }
    return dropped;
  }

  /** Drops everything, for example when the stream stops. */
  clear(): DroppedFrame<T>[] {
    const dropped: DroppedFrame<T>[] = [];
    for (const lane of this.#lanes) {
      if (lane.current !== null) {
        const { frame, sent } = lane.current;
        dropped.push(this.#dropped(frame, 'cleared', frame.packets - sent));
        lane.current = null;
      }
      for (const { frame } of lane.waiting.splice(0))
        dropped.push(this.#dropped(frame, 'cleared', frame.packets));
    }
    return dropped;
  }

  /** When `due` has the next packet, possibly in the past; `null` if nothing waits. */
  get nextDueMs(): number | null {
    let next: number | null = null;
    for (const { current, waiting } of this.#lanes) {
      if (current !== null) return this.#nextMs;
      const first = waiting[0];
      // Idle time is not caught up.
      if (first !== undefined)
        next = Math.min(next ?? Number.POSITIVE_INFINITY, Math.max(this.#nextMs, first.sinceMs));
    }
    return next;
  }

  /** The packets of one frame that may be sent now; `null` if there are none. Call again until `null`. */
  due(nowMs: number): PacedRun<T> | null {
    const dueMs = this.nextDueMs;
    if (dueMs === null || dueMs > nowMs) return null;
    const lane = this.#lanes.find(
      ({ current, waiting }) => current !== null || waiting.length > 0,
    ) as Lane<T>;
    const current = lane.current ?? begin(lane, nowMs);
    const { frame } = current;
    const spacingMs = this.#spacingMs(frame);
    const { burstMs, burstBytes, catchUpMs } = this.#options;
    const mostMs = (burstBytes / frame.bytes) * spacingMs * frame.packets;
    this.#nextMs = Math.max(dueMs, nowMs - Math.min(catchUpMs, mostMs));
    const first = current.sent;
    const until = nowMs + Math.min(burstMs, mostMs);
    let count = 0;
    while (first + count < frame.packets && (count === 0 || this.#nextMs < until)) {
      count++;
      this.#nextMs += spacingMs;
    }
    current.sent += count;
    const last = current.sent === frame.packets;
    if (last) lane.current = null;
    return { frame, first, count, last };
  }

  #laneOf({ lane: number = 0 }: T): Lane<T> {
    const known = this.#lanes.find((lane) => lane.number === number);
    if (known !== undefined) return known;
    const lane: Lane<T> = { number, waiting: [], current: null };
    this.#lanes.push(lane);
    this.#lanes.sort((a, b) => a.number - b.number);
    return lane;
  }

  #spacingMs(frame: T): number {
    const { factor } = this.#options;
    const atRateMs = BitRate.msFor(this.#bitsPerSecond * factor, frame.bytes);
    return Math.max(atRateMs, frame.minSpanMs ?? 0) / frame.packets;
  }

  #dropped(frame: T, reason: FrameDropReason, packets: number): DroppedFrame<T> {
    this.#drops[reason]++;
    return { frame, reason, packets };
  }
}

function begin<T>(lane: Lane<T>, nowMs: number): Sending<T> {
  const { frame } = lane.waiting.shift() as { frame: T };
  lane.current = { frame, sent: 0, startMs: nowMs };
  return lane.current;
}
