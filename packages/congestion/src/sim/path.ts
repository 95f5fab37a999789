import type { Bottleneck } from './bottleneck.ts';
import type { Random } from './random.ts';
import type { Stalls } from './stalls.ts';

export interface PathOptions {
  /** Shared by all flows that pass it. `null`: none. */
  bottleneck: Bottleneck | null;
  /** Propagation, ms, behind the bottleneck. */
  delayMs: number;
  /** From when on the way is longer or shorter, and by how much, ms: another route. In order of time. */
  delaySteps?: readonly (readonly [fromMs: number, moreMs: number])[];
  /** Mean of an exponentially distributed extra delay, ms. It never reorders. */
  jitterMs?: number;
  /** Delay that varies evenly by up to so much, ms, drawn anew each 10 ms, as a radio's scheduler has it; no overtaking. */
  wobbleMs?: number;
  /** Packets, 0–1, that are held back by `reorderMs` and overtaken meanwhile. */
  reorder?: number;
  reorderMs?: number;
  /** Lost anywhere on the way, 0–1. */
  loss?: number;
  /** The link stands still: what comes or is due to leave meanwhile does so afterwards, and the link's time is lost. */
  linkStalls?: Stalls | null;
  /** The receiver stands still: it notes what comes meanwhile as come at the end. */
  receiverStalls?: Stalls | null;
}

const WOBBLE_EVERY_MS = 10;

/** What happened to a packet on its way. */
export interface Passage {
  /** When it arrives, ms; Infinity: lost. */
  arrivalMs: number;
  /** In the bottleneck, its own serialisation counted, ms; NaN where the queue dropped it. */
  queueMs: number;
}

/** One direction between two ends: a bottleneck, then propagation with jitter and loss. */
export class Path {
  readonly #options: PathOptions;
  readonly #random: Random;
  #lastArrivalMs = 0;
  #wobble = 0;
  #wobbleUntilMs = 0;
  readonly #passage: Passage = { arrivalMs: 0, queueMs: 0 };

  constructor(options: PathOptions, random: Random) {
    this.#options = options;
    this.#random = random;
  }

  /** @returns overwritten by the next call */
  send(bytes: number, nowMs: number): Readonly<Passage> {
    const {
      bottleneck,
      delayMs,
      delaySteps = [],
      jitterMs = 0,
      wobbleMs = 0,
      reorder = 0,
      reorderMs = 0,
      loss = 0,
      linkStalls = null,
      receiverStalls = null,
    } = this.#options;
    const passage = this.#passage;
    const enters = linkStalls === null ? nowMs : linkStalls.after(nowMs);
    let leaves = bottleneck === null ? enters : bottleneck.enter(bytes, enters);
    if (leaves >= 0 && linkStalls !== null) leaves = linkStalls.after(leaves);
    if (leaves < 0) {
      passage.arrivalMs = Number.POSITIVE_INFINITY;
      passage.queueMs = Number.NaN;
      return passage;
    }
    passage.queueMs = leaves - nowMs;
    const jitter = jitterMs > 0 ? -jitterMs * Math.log(1 - this.#random()) : 0;
    if (wobbleMs > 0 && nowMs >= this.#wobbleUntilMs) {
      this.#wobbleUntilMs = nowMs + WOBBLE_EVERY_MS;
      this.#wobble = wobbleMs * (2 * this.#random() - 1);
    }
    const moreMs = delaySteps.findLast(([fromMs]) => nowMs >= fromMs)?.[1] ?? 0;
    let arrival = Math.max(leaves + delayMs + moreMs + jitter + this.#wobble, this.#lastArrivalMs);
    if (reorder > 0 && this.#random() < reorder) arrival += reorderMs;
    else this.#lastArrivalMs = arrival;
    const lost = (bottleneck?.loses() ?? false) || (loss > 0 && this.#random() < loss);
    if (receiverStalls !== null) arrival = receiverStalls.after(arrival);
    passage.arrivalMs = lost ? Number.POSITIVE_INFINITY : arrival;
    return passage;
  }
}
