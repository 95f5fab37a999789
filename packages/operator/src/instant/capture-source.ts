/** One source of a compositor: what waits to be presented, and how regularly it comes. Time is an argument. */
import { RecentValues } from './recent-values.ts';

/** Why an item is not presented. */
export type ItemDropReason =
  /** A newer item of its source was presented instead. */
  | 'superseded'
  /** What it belongs to was presented before it came. */
  | 'late'
  /** Too many items of its source wait. */
  | 'overflow'
  /** Its source was removed, or the compositor emptied. */
  | 'removed';

/** Something that was captured, and waits to be presented. */
export interface CapturedItem<Payload> {
  readonly captureMs: number;
  readonly arrivedMs: number;
  readonly payload: Payload;
}

/** Enough for the longest wait at 60 a second; a decoder may have only few more pictures. */
const MOST_WAITING = 6;
/** Until two items have come, ms. */
const ASSUMED_INTERVAL_MS = 1000 / 30;
const INTERVALS_KEPT = 8;
const DELAYS_KEPT = 16;
/** A source is silent after so many of its intervals without an item, ms at least. */
const SILENT_INTERVALS = 4;
const SILENT_MS = 250;

export class CaptureSource<Payload> {
  readonly name: string;
  /** Whether its items are shown only once they are presented. */
  readonly isHeld: boolean;
  /** What waits, by capture instant. */
  readonly waiting: CapturedItem<Payload>[] = [];
  /** Capture instant of what is presented; `null` before the first. */
  shownMs: number | null = null;
  /** Typical time between two captures, ms. */
  intervalMs = ASSUMED_INTERVAL_MS;
  /** Typical delay from capture to arrival, ms; only differences between sources mean anything. */
  delayMs = 0;
  /** Whether this source was presented in step with others by the last {@link Compositor.decide}. */
  inStep = false;
  #newestMs = Number.NEGATIVE_INFINITY;
  #arrivedMs = Number.NEGATIVE_INFINITY;
  readonly #intervals = new RecentValues(INTERVALS_KEPT);
  readonly #delays = new RecentValues(DELAYS_KEPT);

  constructor(name: string, isHeld: boolean) {
    this.name = name;
    this.isHeld = isHeld;
  }

  /** @param drop called for each item that will not be presented, this one or another */
  offer(item: CapturedItem<Payload>, drop: (item: CapturedItem<Payload>, reason: ItemDropReason) => void) {
    this.#observe(item);
    if (this.shownMs !== null && item.captureMs <= this.shownMs) return drop(item, 'late');
    const { waiting } = this;
    let at = waiting.length;
    while (at > 0 && (waiting[at - 1] as CapturedItem<Payload>).captureMs >= item.captureMs) at--;
    const twin = waiting[at]?.captureMs === item.captureMs ? 1 : 0;
    for (const replaced of waiting.splice(at, twin, item)) drop(replaced, 'superseded');
    if (waiting.length > MOST_WAITING) drop(waiting.shift() as CapturedItem<Payload>, 'overflow');
  }

  isSilent(nowMs: number): boolean {
    return nowMs - this.#arrivedMs > Math.max(SILENT_INTERVALS * this.intervalMs, SILENT_MS);
  }

  #observe({ captureMs, arrivedMs }: CapturedItem<Payload>): void {
    this.#arrivedMs = arrivedMs;
    this.#delays.add(arrivedMs - captureMs);
    this.delayMs = this.#delays.quantile(0.5) ?? 0;
    if (captureMs <= this.#newestMs) return;
    if (this.#newestMs !== Number.NEGATIVE_INFINITY) {
      this.#intervals.add(captureMs - this.#newestMs);
      // Losses make intervals longer, nothing makes them shorter: not the median but the lower quartile.
      this.intervalMs = this.#intervals.quantile(0.25) ?? ASSUMED_INTERVAL_MS;
    }
    this.#newestMs = captureMs;
  }
}
