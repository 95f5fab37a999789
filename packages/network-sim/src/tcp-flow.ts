import { type CongestionWindow, CubicWindow, RenoWindow } from './congestion-window.ts';
import type { CrossFlow } from './cross-flow.ts';

export interface TcpFlowOptions {
  readonly congestionControl: 'cubic' | 'reno';
  readonly startMs: number;
  /** When the flow ends; never if absent. */
  readonly endMs?: number;
  /** How much to send, on the wire and in whole segments; unlimited if absent. */
  readonly bytes?: number;
  /** From a segment's delivery until the sender receives its acknowledgement. */
  readonly ackDelayMs: number;
}

/** 1448 bytes of data with TCP (timestamps) and IPv4 headers. */
const WIRE_BYTES = 1500;
/** Segments delivered beyond a missing one before it counts as lost (RFC 6675). */
const REORDERING = 3;
/** As in Linux; RFC 6298 asks for 1 s. */
const LEAST_RTO_MS = 200;
const MOST_RTO_MS = 60_000;
/** Maximum number of segments between the oldest missing one and the newest sent. */
const SPAN = 65_536;
const OUTSTANDING = 1;
const ACKNOWLEDGED = 2;

/**
 * A bulk TCP sender as the link sees it: every segment is acknowledged, the ack clock includes the link's own queueing
 * delay, and losses are detected by selective acknowledgements or by time-out. A lost segment is not sent again as
 * such: the next segment takes its place, which loads the link in the same way. Deterministic.
 */
export class TcpFlow implements CrossFlow {
  readonly #window: CongestionWindow;
  readonly #ackDelayMs: number;
  readonly #endMs: number;
  #startMs: number;
  /** Still to be sent. */
  #segmentsLeft: number;
  /** State and sending time of each segment, by its number modulo SPAN. */
  readonly #state = new Uint8Array(SPAN);
  readonly #sentMs = new Float64Array(SPAN);
  /** Acknowledgements in transit, in order. */
  readonly #ackSegment = new Int32Array(SPAN);
  readonly #ackMs = new Float64Array(SPAN);
  #ackHead = 0;
  #ackTail = 0;
  #oldest = 0;
  #next = 0;
  #highest = -1;
  #inFlight = 0;
  /** Whether the window, not the data, limited the latest sending. */
  #limited = false;
  /** A loss before this segment belongs to the previous reduction. */
  #recoveredAt = 0;
  #smoothedMs = 0;
  #variationMs = 0;
  #rtoMs = 1000;
  #rtoAtMs = Number.POSITIVE_INFINITY;
  /** Congestion events so far. */
  reductions = 0;
  timeouts = 0;

  constructor(options: TcpFlowOptions) {
    this.#window = options.congestionControl === 'cubic' ? new CubicWindow() : new RenoWindow();
    this.#ackDelayMs = options.ackDelayMs;
    this.#startMs = options.startMs;
    this.#endMs = options.endMs ?? Number.POSITIVE_INFINITY;
    this.#segmentsLeft = Math.ceil((options.bytes ?? Number.POSITIVE_INFINITY) / WIRE_BYTES);
  }

  /** Segments. */
  get window(): number {
    return this.#window.segments;
  }

  get nextMs(): number {
    const ackMs =
      this.#ackHead === this.#ackTail ? Number.POSITIVE_INFINITY : this.#ackMs[this.#ackHead & (SPAN - 1)]!;
    return Math.min(this.#startMs, ackMs, this.#rtoAtMs);
  }

  run(nowMs: number, send: (handle: number, wireBytes: number) => boolean): void {
    if (nowMs >= this.#startMs) this.#startMs = Number.POSITIVE_INFINITY;
    while (this.#ackHead !== this.#ackTail && this.#ackMs[this.#ackHead & (SPAN - 1)]! <= nowMs) {
      this.#acknowledge(this.#ackSegment[this.#ackHead++ & (SPAN - 1)]!, nowMs);
    }
    if (this.#rtoAtMs <= nowMs) this.#timeOut(nowMs);
    if (nowMs >= this.#endMs) {
      if (this.#inFlight === 0) this.#rtoAtMs = Number.POSITIVE_INFINITY;
      return;
    }
    while (
      this.#segmentsLeft > 0 &&
      this.#inFlight < Math.floor(this.#window.segments) &&
      this.#next - this.#oldest < SPAN / 2
    ) {
      const segment = this.#next++;
      this.#segmentsLeft--;
      this.#state[segment & (SPAN - 1)] = OUTSTANDING;
      this.#sentMs[segment & (SPAN - 1)] = nowMs;
      this.#inFlight++;
      // A drop shows only in later acknowledgements, as for a real sender.
      send(segment, WIRE_BYTES);
    }
    this.#limited = this.#inFlight >= Math.floor(this.#window.segments);
    if (this.#inFlight === 0) this.#rtoAtMs = Number.POSITIVE_INFINITY;
    else if (this.#rtoAtMs === Number.POSITIVE_INFINITY) this.#rtoAtMs = nowMs + this.#rtoMs;
  }

  delivered(handle: number, atMs: number): void {
    const at = this.#ackTail++ & (SPAN - 1);
    this.#ackSegment[at] = handle;
    this.#ackMs[at] = atMs + this.#ackDelayMs;
  }

  #acknowledge(segment: number, nowMs: number): void {
    if (segment < this.#oldest || this.#state[segment & (SPAN - 1)] === ACKNOWLEDGED) return;
    this.#state[segment & (SPAN - 1)] = ACKNOWLEDGED;
    this.#inFlight--;
    const rttMs = nowMs - this.#sentMs[segment & (SPAN - 1)]!;
    this.#measure(rttMs);
    if (segment > this.#highest) this.#highest = segment;
    let lost = false;
    while (this.#oldest < this.#next) {
      if (this.#state[this.#oldest & (SPAN - 1)] === OUTSTANDING) {
        if (this.#oldest + REORDERING > this.#highest) break;
        this.#inFlight--;
        this.#segmentsLeft++;
        lost ||= this.#oldest >= this.#recoveredAt;
      }
      this.#oldest++;
    }
    if (lost) {
      this.reductions++;
      this.#window.lost(nowMs);
      this.#recoveredAt = this.#next;
    } else if (this.#limited && this.#oldest >= this.#recoveredAt) {
      this.#window.acknowledged(nowMs, rttMs);
    }
    this.#rtoAtMs = nowMs + this.#rtoMs;
  }

  #timeOut(nowMs: number): void {
    this.#rtoAtMs = Number.POSITIVE_INFINITY;
    if (this.#inFlight === 0) return;
    this.timeouts++;
    this.#window.timedOut();
    this.#oldest = this.#recoveredAt = this.#next;
    this.#segmentsLeft += this.#inFlight;
    this.#inFlight = 0;
    this.#rtoMs = Math.min(2 * this.#rtoMs, MOST_RTO_MS);
    this.#rtoAtMs = nowMs + this.#rtoMs;
  }

  /** RFC 6298. */
  #measure(rttMs: number): void {
    if (this.#smoothedMs === 0) {
      this.#smoothedMs = rttMs;
      this.#variationMs = rttMs / 2;
    } else {
      this.#variationMs += (Math.abs(this.#smoothedMs - rttMs) - this.#variationMs) / 4;
      this.#smoothedMs += (rttMs - this.#smoothedMs) / 8;
    }
    this.#rtoMs = Math.max(this.#smoothedMs + 4 * this.#variationMs, LEAST_RTO_MS);
  }
}
