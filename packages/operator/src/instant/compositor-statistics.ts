/** What a compositor has presented and what not. */
import { type Distribution, SampleWindow } from '../latency/sample-window.ts';
import type { ItemDropReason } from './capture-source.ts';

/** How a source is presented. */
export type SourceState =
  /** Together with what others captured at the same time. */
  | 'in-step'
  /** As it comes: its delay differs too much from the others', or synchronisation is off. */
  | 'apart'
  /** Nothing comes, and nobody waits for it. */
  | 'silent';

/** What became of one source's items. */
export interface SourceFigures {
  /** The name that its items were offered under. */
  source: string;
  /** How it is presented. */
  state: SourceState;
  /** Typical time between two of its captures, ms. */
  intervalMs: number;
  /** How much longer its items take from capture to arrival than those of the fastest source, ms. */
  behindMs: number;
  /** Items that were presented. */
  presented: number;
  /** Presentations that waited for it in vain. */
  waits: number;
  /** Items that were not presented, by reason. */
  drops: Record<ItemDropReason, number>;
}

/** What a compositor did. The counts begin when it is made or emptied. */
export interface CompositorStats {
  /** Whether synchronisation is on. */
  synchronised: boolean;
  /** Presentations so far. */
  presentations: number;
  /**
   * Between the earliest and the latest capture instant among what the held sources that are not silent showed, after each
   * of the latest presentations, ms; `null` while fewer than two sources show anything.
   */
  spreadMs: Distribution | null;
  /** How long presented items waited, since they arrived, ms; `null` before the first. */
  heldMs: Distribution | null;
  /** Each source, in the order in which they came. */
  sources: SourceFigures[];
}

/** About a quarter of a minute at 60 presentations a second. */
const SPREADS_KEPT = 1024;

interface Counts {
  presented: number;
  waits: number;
  readonly drops: Record<ItemDropReason, number>;
}

export class CompositorStatistics {
  presentations = 0;
  readonly #spread = new SampleWindow(SPREADS_KEPT);
  readonly #held = new SampleWindow(SPREADS_KEPT);
  readonly #counts = new Map<string, Counts>();

  get heldMs(): Distribution | null {
    return this.#held.distribution();
  }

  onHeld(ms: number): void {
    this.#held.add(ms);
  }

  get spreadMs(): Distribution | null {
    return this.#spread.distribution();
  }

  /** @param shownMs capture instants of what is shown now */
  onPresented(shownMs: readonly number[]): void {
    this.presentations++;
    if (shownMs.length > 1) this.#spread.add(Math.max(...shownMs) - Math.min(...shownMs));
  }

  /** Begin with this for each source: what is counted of others stays nowhere. */
  of(source: string): Counts {
    let counts = this.#counts.get(source);
    if (counts === undefined) {
      counts = { presented: 0, waits: 0, drops: { superseded: 0, late: 0, overflow: 0, removed: 0 } };
      this.#counts.set(source, counts);
    }
    return counts;
  }

  forget(source: string): void {
    this.#counts.delete(source);
  }

  /** Restarts the distribution; the counts continue. */
  resetDistributions(): void {
    this.#spread.clear();
    this.#held.clear();
  }

  clear(): void {
    this.presentations = 0;
    this.#counts.clear();
    this.resetDistributions();
  }
}
