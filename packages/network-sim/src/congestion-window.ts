/** How the window of a TCP sender grows and shrinks, in segments. Times in milliseconds. */
export interface CongestionWindow {
  readonly segments: number;
  /** New data was acknowledged, and the window limits what is sent. */
  acknowledged(nowMs: number, rttMs: number): void;
  /** At most once per round trip. */
  lost(nowMs: number): void;
  timedOut(): void;
}

const INITIAL_WINDOW = 10; // RFC 6928
const LEAST_WINDOW = 2;
/** RFC 9438 §4.1 and §4.6. */
const CUBIC_C = 0.4;
const CUBIC_BETA = 0.7;
const CUBIC_ALPHA = (3 * (1 - CUBIC_BETA)) / (1 + CUBIC_BETA);
/** RFC 9406 §4.2. */
const HYSTART_SAMPLES = 8;
const HYSTART_LEAST_RISE_MS = 4;
const HYSTART_MOST_RISE_MS = 16;
const HYSTART_DIVISOR = 8;

/** RFC 5681 with a window in segments: slow start, then one segment per round trip; halved after a loss. */
export class RenoWindow implements CongestionWindow {
  segments = INITIAL_WINDOW;
  #threshold = Number.POSITIVE_INFINITY;

  acknowledged(): void {
    this.segments += this.segments < this.#threshold ? 1 : 1 / this.segments;
  }

  lost(): void {
    this.#threshold = Math.max(this.segments / 2, LEAST_WINDOW);
    this.segments = this.#threshold;
  }

  timedOut(): void {
    this.#threshold = Math.max(this.segments / 2, LEAST_WINDOW);
    this.segments = 1;
  }
}

/**
 * Detects that slow start has begun to fill the queue: HyStart++'s delay test (RFC 9406) without its conservative
 * phase.
 */
class SlowStartExit {
  #samples = 0;
  #leastMs = Number.POSITIVE_INFINITY;
  #leastBeforeMs = Number.POSITIVE_INFINITY;
  #left = 0;

  /** Processes one acknowledgement in slow start. A round has as many of them as the window held when it began. */
  reached(rttMs: number, segments: number): boolean {
    if (this.#left <= 0) {
      this.#left = segments;
      this.#samples = 0;
      this.#leastBeforeMs = this.#leastMs;
      this.#leastMs = Number.POSITIVE_INFINITY;
    }
    this.#left--;
    this.#samples++;
    this.#leastMs = Math.min(this.#leastMs, rttMs);
    if (this.#samples < HYSTART_SAMPLES || this.#leastBeforeMs === Number.POSITIVE_INFINITY) return false;
    const rise = this.#leastBeforeMs / HYSTART_DIVISOR;
    return (
      this.#leastMs >=
      this.#leastBeforeMs + Math.min(Math.max(rise, HYSTART_LEAST_RISE_MS), HYSTART_MOST_RISE_MS)
    );
  }
}

/** RFC 9438, with fast convergence (§4.7) and HyStart++'s delay test at the end of slow start. */
export class CubicWindow implements CongestionWindow {
  segments = INITIAL_WINDOW;
  #threshold = Number.POSITIVE_INFINITY;
  #slowStart = new SlowStartExit();
  /** Window just before the latest reduction, lowered by fast convergence: the plateau. */
  #maximum = 0;
  /** Window just before the latest reduction. */
  #before = 0;
  #epochMs: number | null = null;
  #k = 0;
  /** The window that Reno would have by now (§4.3). */
  #reno = 0;

  acknowledged(nowMs: number, rttMs: number): void {
    if (this.segments < this.#threshold) {
      const risen = this.#slowStart.reached(rttMs, this.segments);
      this.segments++;
      if (risen) this.#threshold = this.segments;
      return;
    }
    if (this.#epochMs === null) {
      this.#epochMs = nowMs;
      this.#maximum = Math.max(this.#maximum, this.segments);
      this.#k = Math.cbrt((this.#maximum - this.segments) / CUBIC_C);
      this.#reno = this.segments;
    }
    const sinceS = (nowMs - this.#epochMs) / 1000;
    this.#reno += (this.#reno < this.#before ? CUBIC_ALPHA : 1) / this.segments;
    if (this.#curve(sinceS) < this.#reno) {
      this.segments = Math.max(this.segments, this.#reno);
      return;
    }
    const target = Math.min(Math.max(this.#curve(sinceS + rttMs / 1000), this.segments), 1.5 * this.segments);
    this.segments += (target - this.segments) / this.segments;
  }

  lost(): void {
    this.#reduce();
    this.segments = this.#threshold;
  }

  timedOut(): void {
    this.#reduce();
    this.segments = 1;
    this.#slowStart = new SlowStartExit();
  }

  #reduce(): void {
    this.#before = this.segments;
    this.#maximum = this.segments < this.#maximum ? (this.segments * (1 + CUBIC_BETA)) / 2 : this.segments;
    this.#threshold = Math.max(this.segments * CUBIC_BETA, LEAST_WINDOW);
    this.#epochMs = null;
  }

  #curve(seconds: number): number {
    return CUBIC_C * (seconds - this.#k) ** 3 + this.#maximum;
  }
}
