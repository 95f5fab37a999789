import type { ClockAnswer } from './control.ts';
import { sequenceDelta32 } from './sequence.ts';

/** The offset is at least and at most this: the robot read its clock after the question and before its answer came. */
interface Bounds {
  readonly leastMs: number;
  readonly mostMs: number;
}

/** What lies between the bounds of a probe is its round trip. */
const rttOf = ({ leastMs, mostMs }: Bounds) => mostMs - leastMs;
const middleOf = ({ leastMs, mostMs }: Bounds) => (leastMs + mostMs) / 2;

/**
 * The operator's estimate of the robot's clock, from probes and answers (NTP's on-wire calculation, RFC 5905 §8, with
 * the robot's turnaround taken as 0). Each probe bounds the offset on both sides. Queueing only ever adds delay, so
 * that the middle of what all of the last probes allow is used: the quickest way there and the quickest way back count,
 * also where no single probe was quick both ways, as on a busy machine. Clocks that drift may leave nothing that all
 * allow; then the probe with the shortest round trip counts alone.
 */
export class ClockOffset {
  readonly #window: Bounds[] = [];
  readonly #size: number;
  #offsetMs: number | null = null;
  #minRttMs: number | null = null;

  /** @param size how many probes to choose from */
  constructor(size = 16) {
    this.#size = size;
  }

  /** @param receivedMs the operator's clock when the answer arrived */
  add({ sentMs, robotMs }: ClockAnswer, receivedMs: number): void {
    if (receivedMs < sentMs) return;
    this.#window.push({ leastMs: robotMs - receivedMs, mostMs: robotMs - sentMs });
    if (this.#window.length > this.#size) this.#window.shift();
    this.#estimate();
  }

  /** Robot clock minus operator clock, ms; `null` before the first answer. */
  get offsetMs(): number | null {
    return this.#offsetMs;
  }

  /** Shortest round trip among the last probes, ms. */
  get minRttMs(): number | null {
    return this.#minRttMs;
  }

  /** Round trip of the latest probe, ms. */
  get lastRttMs(): number | null {
    const last = this.#window.at(-1);
    return last === undefined ? null : rttOf(last);
  }

  /** As many answers as are chosen from have come: further ones refine the estimate, but no longer change it much. */
  get settled(): boolean {
    return this.#window.length === this.#size;
  }

  #estimate(): void {
    let [leastMs, mostMs] = [-Infinity, Infinity];
    let shortest = this.#window[0] as Bounds;
    for (const probe of this.#window) {
      leastMs = Math.max(leastMs, probe.leastMs);
      mostMs = Math.min(mostMs, probe.mostMs);
      if (rttOf(probe) < rttOf(shortest)) shortest = probe;
    }
    this.#minRttMs = rttOf(shortest);
    this.#offsetMs = middleOf(leastMs <= mostMs ? { leastMs, mostMs } : shortest);
  }
}

/** The wrapping u32 microsecond stamp of an instant on the robot's monotonic clock, given in ms. */
export function stampUsOf(robotMs: number): number {
  return Math.floor((robotMs * 1000) % 0x1_0000_0000) >>> 0;
}

/**
 * Age of a wrapping u32 microsecond timestamp of the robot, ms.
 *
 * @param robotNowMs the robot's monotonic clock now, ms, as estimated by the reader; may be slightly behind the
 * timestamp
 */
export function ageOfStampMs(stampUs: number, robotNowMs: number): number {
  return sequenceDelta32(stampUsOf(robotNowMs), stampUs) / 1000;
}
