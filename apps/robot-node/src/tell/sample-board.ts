/** The samples of quantities that wait to be sent. */

import {
  type Alarm,
  type DiagnosticReport,
  MAX_SAMPLES,
  type Quantity,
  type Sample,
  type Samples,
} from '@farpoint/protocol';
import { quantitiesOf, type TopicEntry } from '@farpoint/ros';

/** Takes what the robot tells about itself besides its state, for a recording. Times are of the robot's clock, ms. */
export interface TelemetryTaker {
  /** @param timeMs when it was measured */
  sample(quantity: number, timeMs: number, value: number): void;
  /** @param timeMs when it changed, or when it is repeated */
  alarm(number: number, timeMs: number, alarm: Alarm): void;
  /** @param reports of all components of the topic @param timeMs when the newest came */
  diagnostics(topic: string, timeMs: number, reports: readonly DiagnosticReport[]): void;
}

interface Taken {
  number: number;
  timeMs: number;
  value: number;
}

/** The quantities of a table of topics, numbered in its order. */
export function describeQuantities(topics: readonly TopicEntry[]): Quantity[] {
  return topics
    .flatMap((entry) => quantitiesOf(entry).map((quantity) => ({ topic: entry.topic, ...quantity })))
    .map((quantity, number) => ({ type: 'quantity', number, ...quantity }));
}

/** Keeps what has come since the last messages, for operators with a wide and with a narrow path. */
export class SampleBoard {
  /** Samples that were not sent because more came than fit a message. */
  dropped = 0;
  readonly #firstOf = new Map<string, number>();
  #waiting: Taken[] = [];
  readonly #newest = new Map<number, Taken>();

  constructor(quantities: readonly Quantity[]) {
    for (const { topic, number } of quantities)
      if (!this.#firstOf.has(topic)) this.#firstOf.set(topic, number);
  }

  /**
   * @param numbers the topic's quantities, in their order
   * @param timeMs robot's clock
   * @param taker gets each sample, too
   */
  add(
    topic: string,
    numbers: readonly (number | null)[],
    timeMs: number,
    taker: Pick<TelemetryTaker, 'sample'> | null = null,
  ): void {
    const first = this.#firstOf.get(topic);
    if (first === undefined) return;
    numbers.forEach((value, i) => {
      if (value === null) return;
      this.addOne(first + i, value, timeMs);
      taker?.sample(first + i, timeMs, value);
    });
  }

  /** @param number of the quantity @param timeMs robot's clock */
  addOne(number: number, value: number, timeMs: number): void {
    const taken = { number, timeMs, value };
    this.#newest.set(number, taken);
    this.#waiting.push(taken);
    if (this.#waiting.length <= MAX_SAMPLES) return;
    this.#waiting.shift();
    this.dropped++;
  }

  /** Everything since the last call; `null` if there was nothing. */
  all(): Samples | null {
    const message = messageOf(this.#waiting);
    this.#waiting = [];
    return message;
  }

  /** The newest sample of each quantity that has one since the last call; `null` if none has. */
  newest(): Samples | null {
    const message = messageOf([...this.#newest.values()]);
    this.#newest.clear();
    return message;
  }
}

function messageOf(taken: readonly Taken[]): Samples | null {
  if (taken.length === 0) return null;
  const timeMs = taken.reduce((newest, each) => Math.max(newest, each.timeMs), 0);
  const samples = taken.map(({ number, timeMs: at, value }): Sample => {
    // A tenth of a millisecond; never -0, which JSON would not keep.
    const offsetMs = Math.round((at - timeMs) * 10) / 10;
    return [number, offsetMs === 0 ? 0 : offsetMs, value];
  });
  return { type: 'samples', timeMs, samples };
}
