/** Presents together what was captured together. No clock and no picture here: time and payloads are arguments. */
import { type CapturedItem, CaptureSource, type ItemDropReason } from './capture-source.ts';
import { CompositorStatistics, type CompositorStats } from './compositor-statistics.ts';
import { fastestMsOf, newestStep, slowestMsOf, standsForMs } from './newest-step.ts';
import { stepMembers } from './step-members.ts';

/** An item that is presented now. Whoever takes the presentation owns the payload. */
export interface PresentedItem<Payload> {
  /** The name that it was offered under. */
  readonly source: string;
  /** When it was captured: ms on the robot's clock. */
  readonly captureMs: number;
  /** What was offered. */
  readonly payload: Payload;
}

/** What is to be shown at once. Sources without an item keep what they show. */
export interface Presentation<Payload> {
  /** The newest capture instant among the items, ms on the robot's clock. */
  readonly instantMs: number;
  /** At most one of each source. */
  readonly items: readonly PresentedItem<Payload>[];
  /** Sources whose items were waited for in vain. */
  readonly waitedFor: readonly string[];
}

/** An item that will not be presented. Whoever hears of it owns the payload. */
export interface DroppedItem<Payload> extends PresentedItem<Payload> {
  /** Why it is not presented. */
  readonly reason: ItemDropReason;
}

/** What a {@link Compositor} is made with. */
export interface CompositorOptions<Payload> {
  /** Called once for each payload that will not be presented, for closing it. */
  onDrop(dropped: DroppedItem<Payload>): void;
  /** `false`: present each source's items as they come; default: `true`. */
  synchronised?: boolean;
  /**
   * Whether a source's items are shown only once they are presented; default: all. Others, e.g. clouds whose points are
   * drawn as they come, make held ones wait, but count neither for the spread nor for who is in step with whom.
   */
  holds?(source: string): boolean;
}

/**
 * Presents together what several sources captured together, although their items arrive at different times: a video's
 * frame waits for the other cameras' frames of the same instant, but never longer than an interval of the slowest
 * source and 10 ms. A source whose delay differs by more than that from the others', or that is silent, is presented by
 * itself, and nobody waits for it. Every payload comes out exactly once, presented or dropped.
 */
export class Compositor<Payload> {
  /** Whether items wait for others. May be changed at any time. */
  synchronised: boolean;
  readonly #options: CompositorOptions<Payload>;
  readonly #sources = new Map<string, CaptureSource<Payload>>();
  readonly #statistics = new CompositorStatistics();
  /** Capture instant of the newest step: what belongs to earlier ones comes too late. */
  #steppedMs = Number.NEGATIVE_INFINITY;

  constructor(options: CompositorOptions<Payload>) {
    this.#options = options;
    this.synchronised = options.synchronised ?? true;
  }

  /**
   * Takes an item, to be presented by a later {@link decide}.
   *
   * @param source names what it comes from; the caller limits how many there are
   * @param captureMs when it was captured: ms on the robot's clock, the same clock for all sources
   * @param nowMs when it arrived: ms on the clock of {@link decide}
   */
  offer(source: string, captureMs: number, payload: Payload, nowMs: number): void {
    let into = this.#sources.get(source);
    if (into === undefined) {
      into = new CaptureSource(source, this.#options.holds?.(source) ?? true);
      this.#sources.set(source, into);
    }
    const item = { captureMs, arrivedMs: nowMs, payload };
    const from = into;
    from.offer(item, (dropped, reason) => this.#drop(from, dropped, reason));
  }

  /**
   * Decides what is shown from now on. Call it for each display frame.
   *
   * @returns `null` if nothing changes
   */
  decide(nowMs: number): Presentation<Payload> | null {
    const members = this.#members(nowMs);
    this.#dropLate(members);
    const step = newestStep(members, nowMs);
    const items = new Map(step?.items);
    for (const source of this.#sources.values()) {
      const newest = source.waiting.at(-1);
      if (!members.has(source) && newest !== undefined) items.set(source, newest);
    }
    if (step !== null) this.#steppedMs = Math.max(this.#steppedMs, step.instantMs);
    if (items.size === 0) return null;
    const waitedFor = (step?.missing ?? []).map(({ name }) => name);
    for (const name of waitedFor) this.#statistics.of(name).waits++;
    const presented = [...items].map(([source, item]) => this.#present(source, item, nowMs));
    this.#statistics.onPresented(this.#shownMs(nowMs));
    const instantMs = Math.max(...presented.map(({ captureMs }) => captureMs));
    return { instantMs, items: presented, waitedFor };
  }

  /** Removes a source that will not come again, and drops what waits of it. */
  remove(source: string): void {
    const removed = this.#sources.get(source);
    if (removed === undefined) return;
    for (const item of removed.waiting.splice(0)) this.#drop(removed, item, 'removed');
    this.#sources.delete(source);
    this.#statistics.forget(source);
  }

  /** Removes all sources, e.g. because another robot's clock begins. */
  clear(): void {
    for (const source of [...this.#sources.keys()]) this.remove(source);
    this.#statistics.clear();
    this.#steppedMs = Number.NEGATIVE_INFINITY;
  }

  /** What was presented and what not. @param nowMs on the clock of {@link decide} */
  stats(nowMs: number): CompositorStats {
    const { presentations, spreadMs, heldMs } = this.#statistics;
    const leastMs = Math.min(...[...this.#sources.values()].map(({ delayMs }) => delayMs));
    const sources = [...this.#sources.values()].map((source) => {
      const { presented, waits, drops } = this.#statistics.of(source.name);
      const state = source.isSilent(nowMs) ? 'silent' : source.inStep ? 'in-step' : 'apart';
      const { name, intervalMs, delayMs } = source;
      const behindMs = delayMs - leastMs;
      return { source: name, state, intervalMs, behindMs, presented, waits, drops: { ...drops } } as const;
    });
    return { synchronised: this.synchronised, presentations, spreadMs, heldMs, sources };
  }

  /** Restarts the distribution of the spread; the counts continue. */
  resetDistributions(): void {
    this.#statistics.resetDistributions();
  }

  /** The sources that are presented in step now. */
  #members(nowMs: number): Set<CaptureSource<Payload>> {
    const live = [...this.#sources.values()].filter((source) => !source.isSilent(nowMs));
    const members = this.synchronised
      ? stepMembers(live, slowestMsOf(live))
      : new Set<CaptureSource<Payload>>();
    for (const source of this.#sources.values()) source.inStep = members.has(source);
    return members;
  }

  /** Drops what belongs to instants before the one that is shown. */
  #dropLate(members: ReadonlySet<CaptureSource<Payload>>): void {
    const fastestMs = fastestMsOf(members);
    for (const source of members) {
      const { waiting, intervalMs } = source;
      const sinceMs = this.#steppedMs - standsForMs(intervalMs, fastestMs);
      while (waiting[0] !== undefined && waiting[0].captureMs < sinceMs)
        this.#drop(source, waiting.shift() as CapturedItem<Payload>, 'late');
    }
  }

  #present(
    source: CaptureSource<Payload>,
    item: CapturedItem<Payload>,
    nowMs: number,
  ): PresentedItem<Payload> {
    const { waiting, name } = source;
    const older = waiting.splice(0, waiting.indexOf(item) + 1).slice(0, -1);
    for (const each of older) this.#drop(source, each, 'superseded');
    source.shownMs = item.captureMs;
    this.#statistics.of(name).presented++;
    this.#statistics.onHeld(Math.max(0, nowMs - item.arrivedMs));
    return { source: name, captureMs: item.captureMs, payload: item.payload };
  }

  #shownMs(nowMs: number): number[] {
    const shown: number[] = [];
    for (const source of this.#sources.values()) {
      const { isHeld, shownMs } = source;
      if (shownMs !== null && isHeld && !source.isSilent(nowMs)) shown.push(shownMs);
    }
    return shown;
  }

  #drop(
    source: CaptureSource<Payload>,
    { captureMs, payload }: CapturedItem<Payload>,
    reason: ItemDropReason,
  ) {
    this.#statistics.of(source.name).drops[reason]++;
    this.#options.onDrop({ source: source.name, captureMs, payload, reason });
  }
}
