/** Capacity over time: piecewise constant, in bits per millisecond, read forward in amortised constant time. */
import { BitRate } from '@farpoint/timing';

/** Capacity from `atMs` on, until the next step. */
export interface CapacityStep {
  /** Since the schedule began. */
  readonly atMs: number;
  /** 10^6 bit/s; 0 is an outage, Infinity no bottleneck. */
  readonly mbps: number;
}

/** From `startMs` until before `endMs`, nothing is served, whatever the steps say. Times since the schedule began. */
export interface Outage {
  readonly startMs: number;
  readonly endMs: number;
}

export interface CapacitySpec {
  /** At least one step; strictly increasing times. The first step's capacity also applies before it. */
  readonly steps: readonly CapacityStep[];
  /** The steps repeat after this long, which must exceed the last step's time; `null` holds the last step for ever. */
  readonly periodMs: number | null;
  readonly outages?: readonly Outage[] | undefined;
}

/** Thrown for an invalid schedule. */
export class CapacityError extends Error {
  override readonly name = 'CapacityError';
}

export const unlimitedCapacity: CapacitySpec = {
  steps: [{ atMs: 0, mbps: Number.POSITIVE_INFINITY }],
  periodMs: null,
};

export function constantCapacity(mbps: number): CapacitySpec {
  return { steps: [{ atMs: 0, mbps }], periodMs: null };
}

/** Bits per millisecond in 1 Mbit/s. */
const BITS_PER_MS = BitRate.bitsIn(BitRate.fromMbps(1), 1);

/** A specification placed on the clock: its time 0 is `originMs`. */
export class CapacitySchedule {
  readonly #times: Float64Array;
  readonly #rates: Float64Array;
  readonly #outages: readonly Outage[];
  readonly #originMs: number;
  readonly #periodMs: number;
  #index = 0;
  #outage = 0;
  /** End of the segment found last; see {@link seek}. */
  segmentEndMs = Number.NEGATIVE_INFINITY;
  /** Bits per millisecond in that segment. */
  rate = 0;
  #segmentStartMs = Number.POSITIVE_INFINITY;

  /** @throws {CapacityError} */
  constructor(spec: CapacitySpec, originMs: number) {
    const { steps, periodMs, outages = [] } = spec;
    if (steps.length === 0) throw new CapacityError('capacity: needs at least one step');
    steps.forEach(({ atMs, mbps }, index) => {
      if (!(mbps >= 0)) throw new CapacityError(`capacity: step ${index}: ${mbps} Mbit/s is not 0 or more`);
      if (!Number.isFinite(atMs) || (index > 0 && atMs <= steps[index - 1]!.atMs)) {
        throw new CapacityError(
          `capacity: step ${index}: its time ${atMs} ms is not after the step before it`,
        );
      }
    });
    if (periodMs !== null && !(periodMs > steps.at(-1)!.atMs && Number.isFinite(periodMs))) {
      throw new CapacityError(`capacity: the period ${periodMs} ms does not end after the last step`);
    }
    outages.forEach(({ startMs, endMs }, index) => {
      if (!(startMs < endMs) || (index > 0 && startMs < outages[index - 1]!.endMs)) {
        throw new CapacityError(`capacity: outage ${index} is empty or begins before the one before it ends`);
      }
    });
    this.#times = Float64Array.from(steps, ({ atMs }) => atMs);
    this.#rates = Float64Array.from(steps, ({ mbps }) => mbps * BITS_PER_MS);
    this.#outages = outages;
    this.#originMs = originMs;
    this.#periodMs = periodMs ?? Number.POSITIVE_INFINITY;
  }

  /**
   * Sets {@link rate} and {@link segmentEndMs} to those of the segment that contains `ms`. Cheap only if the times
   * increase.
   */
  seek(ms: number): void {
    if (ms >= this.#segmentStartMs && ms < this.segmentEndMs) return;
    const since = ms - this.#originMs;
    const looped = this.#periodMs !== Number.POSITIVE_INFINITY && since >= 0;
    let cycles = looped ? Math.floor(since / this.#periodMs) : 0;
    // The end of a cycle as computed below must lie in the next cycle, whatever the rounding.
    while (looped && this.#originMs + (cycles + 1) * this.#periodMs <= ms) cycles++;
    const base = looped ? this.#originMs + cycles * this.#periodMs : this.#originMs;
    const count = this.#times.length;
    let index = this.#index;
    if (base + this.#times[index]! > ms) index = 0;
    while (index + 1 < count && base + this.#times[index + 1]! <= ms) index++;
    this.#index = index;
    let start = index === 0 ? (looped ? base : Number.NEGATIVE_INFINITY) : base + this.#times[index]!;
    let end =
      index + 1 < count
        ? base + this.#times[index + 1]!
        : looped
          ? this.#originMs + (cycles + 1) * this.#periodMs
          : this.#originMs + this.#periodMs;
    let rate = this.#rates[index]!;
    const outages = this.#outages;
    let next = this.#outage;
    if (next > 0 && this.#originMs + outages[next - 1]!.endMs > ms) next = 0;
    while (next < outages.length && this.#originMs + outages[next]!.endMs <= ms) next++;
    this.#outage = next;
    const outage = outages[next];
    if (next > 0) start = Math.max(start, this.#originMs + outages[next - 1]!.endMs);
    if (outage !== undefined) {
      const outageStart = this.#originMs + outage.startMs;
      if (outageStart <= ms) {
        rate = 0;
        start = Math.max(start, outageStart);
        end = Math.min(end, this.#originMs + outage.endMs);
      } else {
        end = Math.min(end, outageStart);
      }
    }
    this.rate = rate;
    this.#segmentStartMs = start;
    this.segmentEndMs = end;
  }

  /** Bits that the link can carry from `fromMs` to `toMs`. */
  bitsBetween(fromMs: number, toMs: number): number {
    let bits = 0;
    for (let ms = fromMs; ms < toMs; ) {
      this.seek(ms);
      const end = Math.min(this.segmentEndMs, toMs);
      bits += this.rate * (end - ms);
      ms = end;
    }
    return bits;
  }
}
