/** Finds the newest instant at which the sources that are in step can be presented together. */
import type { CapturedItem, CaptureSource } from './capture-source.ts';

/** What is presented of one instant. */
export interface Step<Payload> {
  readonly instantMs: number;
  /** The new items; other sources keep what they show. */
  readonly items: Map<CaptureSource<Payload>, CapturedItem<Payload>>;
  /** Sources that were waited for in vain. */
  readonly missing: CaptureSource<Payload>[];
}

/**
 * An item waits for others for an interval of the slowest source, and so much longer, ms: until their next
 * has come. Chosen: what arrivals of one capture differ by; docs/cameras.md is measured with it.
 */
const MARGIN_MS = 10;

export function slowestMsOf(sources: Iterable<{ readonly intervalMs: number }>): number {
  let slowest = 0;
  for (const { intervalMs } of sources) slowest = Math.max(slowest, intervalMs);
  return slowest;
}

/** @returns `null` if nothing new can be presented yet */
export function newestStep<Payload>(
  members: ReadonlySet<CaptureSource<Payload>>,
  nowMs: number,
): Step<Payload> | null {
  const candidates = [...members].flatMap(({ waiting }) => waiting);
  if (candidates.length === 0) return null;
  candidates.sort((a, b) => b.captureMs - a.captureMs);
  const budgetMs = slowestMsOf(members) + MARGIN_MS;
  for (const candidate of candidates) {
    const step = stepAt(members, candidate.captureMs, nowMs < candidate.arrivedMs + budgetMs);
    if (step !== null) return step;
  }
  return null;
}

/** How long after an item's capture it still stands for its source, beside a source of another rate, ms. */
export function standsForMs(intervalMs: number, fastestMs: number): number {
  // Half the interval to the next capture; but of a slower source, all instants of the faster one before that capture.
  return Math.max(intervalMs / 2, intervalMs - fastestMs / 2);
}

export function fastestMsOf(sources: Iterable<{ readonly intervalMs: number }>): number {
  let fastest = Number.POSITIVE_INFINITY;
  for (const { intervalMs } of sources) fastest = Math.min(fastest, intervalMs);
  return fastest;
}

/** @param mayWait whether to wait for sources that have nothing of this instant @returns `null` to wait */
function stepAt<Payload>(
  members: ReadonlySet<CaptureSource<Payload>>,
  instantMs: number,
  mayWait: boolean,
): Step<Payload> | null {
  const fastestMs = fastestMsOf(members);
  const items: Step<Payload>['items'] = new Map();
  const missing: CaptureSource<Payload>[] = [];
  for (const source of members) {
    const { waiting, shownMs, intervalMs } = source;
    const standsMs = standsForMs(intervalMs, fastestMs);
    const nearest = nearestOf(waiting, instantMs);
    const isNear = (captureMs: number) =>
      captureMs <= instantMs ? instantMs - captureMs <= standsMs : captureMs - instantMs <= intervalMs / 2;
    const shownIsNearer =
      shownMs !== null &&
      Math.abs(shownMs - instantMs) <= Math.abs((nearest?.captureMs ?? Number.NaN) - instantMs);
    if (shownMs !== null && isNear(shownMs) && (nearest === null || shownIsNearer)) continue;
    if (nearest !== null && isNear(nearest.captureMs)) {
      items.set(source, nearest);
      continue;
    }
    // A source that has gone on does not go back.
    if (shownMs !== null && shownMs > instantMs) continue;
    if (mayWait) return null;
    missing.push(source);
    // The newest that there is, even if it belongs to an earlier instant.
    const older = waiting.findLast(({ captureMs }) => captureMs <= instantMs);
    if (older !== undefined) items.set(source, older);
  }
  return { instantMs, items, missing };
}

function nearestOf<Payload>(
  items: readonly CapturedItem<Payload>[],
  instantMs: number,
): CapturedItem<Payload> | null {
  let nearest: CapturedItem<Payload> | null = null;
  for (const item of items) {
    const isNearer =
      nearest === null || Math.abs(item.captureMs - instantMs) < Math.abs(nearest.captureMs - instantMs);
    if (isNearer) nearest = item;
  }
  return nearest;
}
