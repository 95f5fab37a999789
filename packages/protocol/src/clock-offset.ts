import type { ClockAnswer } from './control.ts';
import { sequenceDelta32 } from './sequence.ts';

/**
 * The operator's estimate of the robot's clock, from probes and answers (NTP's on-wire calculation, RFC 5905 §8, with
 * the robot's turnaround taken as 0). Of the last probes, the one with the shortest round trip is used, because
 * queueing only ever adds delay.
 */
export class ClockOffset {
  readonly #window: { rttMs: number; offsetMs: number }[] = [];
  readonly #size: number;

  /** @param size how many probes to choose from */
  constructor(size = 16) {
    this.#size = size;
  }

  /** @param receivedMs the operator's clock when the answer arrived */
  add(answer: ClockAnswer, receivedMs: number): void {
    const rttMs = receivedMs - answer.sentMs;
    if (rttMs < 0) return;
    this.#window.push({ rttMs, offsetMs: answer.robotMs - (answer.sentMs + rttMs / 2) });
    if (this.#window.length > this.#size) this.#window.shift();
  }

  /** Robot clock minus operator clock, ms; `null` before the first answer. */
  get offsetMs(): number | null {
    return this.#best()?.offsetMs ?? null;
  }

  /** Shortest round trip among the last probes, ms. */
  get minRttMs(): number | null {
    return this.#best()?.rttMs ?? null;
  }

  /** Round trip of the latest probe, ms. */
  get lastRttMs(): number | null {
    return this.#window.at(-1)?.rttMs ?? null;
  }

  #best(): { rttMs: number; offsetMs: number } | undefined {
    let best = this.#window[0];
    for (const sample of this.#window) if (best === undefined || sample.rttMs < best.rttMs) best = sample;
    return best;
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
