import type { EventQueue } from './event-queue.ts';
import { FlowRecord } from './flow-record.ts';
import type { Path } from './path.ts';

export interface CubicFlowOptions {
  name?: string;
  forward: Path;
  /** From the receiver to the sender, ms; acknowledgements neither wait nor get lost. */
  backDelayMs: number;
  startMs?: number;
  stopMs?: number;
  /** What there is to send; default without end. */
  bytes?: number;
}

const SEGMENT_BYTES = 1500;
const C = 0.4;
const BETA = 0.7;
/** A segment is lost when this many later ones have been acknowledged. */
const REORDERING = 3;

/**
 * A TCP sender with CUBIC (RFC 9438), slow start with HyStart's delay test (RFC 9406, without its conservative phase),
 * selective acknowledgement of each segment and a retransmission time-out of at least 1 s. Retransmissions are new
 * segments: only the load matters.
 */
export class CubicFlow {
  readonly record: FlowRecord;
  readonly #events: EventQueue;
  readonly #options: CubicFlowOptions;
  readonly #stopMs: number;
  #window = 10;
  #threshold = Number.POSITIVE_INFINITY;
  #next = 0;
  #inFlight = 0;
  #highestAcked = -1;
  #lowestOpen = 0;
  readonly #open = new Map<number, number>();
  #recoverUntil = -1;
  #windowMax = 0;
  #epochMs = -1;
  #originWindow = 0;
  #k = 0;
  #friendly = 0;
  #minRtt = Number.POSITIVE_INFINITY;
  #rtt = 100;
  #lastAckMs: number;
  #bytesLeft: number;

  constructor(events: EventQueue, options: CubicFlowOptions) {
    this.#events = events;
    this.#options = options;
    this.#stopMs = options.stopMs ?? Number.POSITIVE_INFINITY;
    this.#bytesLeft = options.bytes ?? Number.POSITIVE_INFINITY;
    this.record = new FlowRecord(options.name ?? 'cubic');
    this.#lastAckMs = options.startMs ?? 0;
    events.at(this.#lastAckMs, () => {
      this.#send();
      this.#watch();
    });
  }

  #send(): void {
    const now = this.#events.nowMs;
    while (this.#inFlight < Math.floor(this.#window) && now < this.#stopMs && this.#bytesLeft > 0) {
      const segment = this.#next++;
      this.#inFlight++;
      this.#bytesLeft -= SEGMENT_BYTES;
      this.#open.set(segment, now);
      const { arrivalMs, queueMs } = this.#options.forward.send(SEGMENT_BYTES, now);
      this.record.sent(SEGMENT_BYTES, now, now, arrivalMs, queueMs);
      if (arrivalMs < Number.POSITIVE_INFINITY) {
        this.#events.at(arrivalMs + this.#options.backDelayMs, () => this.#acked(segment));
      }
    }
  }

  #acked(segment: number): void {
    const now = this.#events.nowMs;
    const sent = this.#open.get(segment);
    if (sent === undefined) return;
    this.#open.delete(segment);
    this.#inFlight--;
    this.#lastAckMs = now;
    const rtt = now - sent;
    this.#rtt += (rtt - this.#rtt) / 8;
    this.#minRtt = Math.min(this.#minRtt, rtt);
    if (segment > this.#highestAcked) this.#highestAcked = segment;
    for (; this.#lowestOpen <= this.#highestAcked - REORDERING; this.#lowestOpen++) {
      if (!this.#open.delete(this.#lowestOpen)) continue;
      this.#inFlight--;
      this.#bytesLeft += SEGMENT_BYTES;
      if (this.#lowestOpen > this.#recoverUntil) this.#reduce();
    }
    if (segment > this.#recoverUntil) this.#grow(rtt, now);
    this.#send();
  }

  #grow(rtt: number, now: number): void {
    if (this.#window < this.#threshold) {
      this.#window++;
      if (this.#window >= 16 && rtt > this.#minRtt + Math.min(Math.max(this.#minRtt / 8, 4), 16))
        this.#threshold = this.#window;
      return;
    }
    if (this.#epochMs < 0) {
      this.#epochMs = now;
      this.#originWindow = this.#window;
      this.#friendly = this.#window;
      if (this.#windowMax < this.#window) this.#windowMax = this.#window;
      this.#k = Math.cbrt((this.#windowMax - this.#window) / C);
    }
    const t = (now - this.#epochMs + this.#minRtt) / 1000;
    const cubic = this.#windowMax + C * (t - this.#k) ** 3;
    this.#friendly += (3 * (1 - BETA)) / (1 + BETA) / this.#window;
    const goal = Math.max(Math.min(cubic, 1.5 * this.#window), this.#friendly, this.#originWindow);
    if (goal > this.#window) this.#window += (goal - this.#window) / this.#window;
  }

  #reduce(): void {
    this.#recoverUntil = this.#next - 1;
    // Fast convergence: a flow that reached less than last time makes room.
    this.#windowMax = this.#window < this.#windowMax ? (this.#window * (1 + BETA)) / 2 : this.#window;
    this.#window = Math.max(this.#window * BETA, 2);
    this.#threshold = this.#window;
    this.#epochMs = -1;
  }

  #watch(): void {
    const now = this.#events.nowMs;
    if (now >= this.#stopMs) return;
    if (this.#inFlight > 0 && now - this.#lastAckMs > Math.max(1000, 3 * this.#rtt)) {
      this.#bytesLeft += this.#open.size * SEGMENT_BYTES;
      this.#open.clear();
      this.#inFlight = 0;
      this.#lowestOpen = this.#next;
      this.#recoverUntil = -1;
      this.#threshold = Math.max(this.#window / 2, 2);
      this.#windowMax = this.#window;
      this.#window = 1;
      this.#epochMs = -1;
      this.#lastAckMs = now;
    }
    this.#send();
    this.#events.at(now + 100, () => this.#watch());
  }
}
