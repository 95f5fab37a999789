/** Runs a compositor in virtual time with sources whose items are lost and delayed, and accounts for every payload. */
import { Compositor, type Presentation } from '../instant/compositor.ts';
import type { CompositorStats } from '../instant/compositor-statistics.ts';

export interface SimulatedSource {
  readonly name: string;
  readonly intervalMs: number;
  /** First capture, ms. */
  readonly phaseMs?: number;
  /** From capture to arrival, at least, and what is added at random, ms. Items arrive in order. */
  readonly delayMs: number;
  readonly jitterMs?: number;
  /** Share of the items that are lost. */
  readonly loss?: number;
  /** Nothing is captured from the first to the second instant, ms. */
  readonly pauseMs?: readonly [number, number];
}

export interface Run {
  readonly presentations: readonly (Presentation<number> & { readonly atMs: number })[];
  /** Capture instants of what each source shows after each presentation. */
  readonly shown: readonly ReadonlyMap<string, number>[];
  /** Time from arrival to presentation of each presented item, ms. */
  readonly waitedMs: readonly number[];
  readonly offered: number;
  /** How often each payload came out. */
  readonly out: readonly number[];
  /** The most payloads that were inside at once. */
  readonly mostInside: number;
  readonly stats: CompositorStats;
}

export interface RunOptions {
  readonly sources: readonly SimulatedSource[];
  readonly lengthMs: number;
  readonly stepMs?: number;
  readonly synchronised?: boolean;
  /** 0…1. */
  random(): number;
}

export function runCompositor({
  sources,
  lengthMs,
  stepMs = 1000 / 60,
  synchronised = true,
  random,
}: RunOptions): Run {
  const arrivals = sources.flatMap((source) => arrivalsOf(source, lengthMs, random));
  arrivals.sort((a, b) => a.atMs - b.atMs);
  const out: number[] = arrivals.map(() => 0);
  let inside = 0;
  const leave = (payload: number): void => {
    out[payload] = (out[payload] as number) + 1;
    inside--;
  };
  const compositor = new Compositor<number>({ synchronised, onDrop: ({ payload }) => leave(payload) });
  const presentations: (Presentation<number> & { atMs: number })[] = [];
  const shown: Map<string, number>[] = [];
  const waitedMs: number[] = [];
  let [next, mostInside] = [0, 0];
  for (let nowMs = 0; nowMs < lengthMs; nowMs += stepMs) {
    for (; next < arrivals.length && (arrivals[next]?.atMs ?? 0) <= nowMs; next++) {
      const { name, captureMs, atMs } = arrivals[next] as Arrival;
      inside++;
      compositor.offer(name, captureMs, next, atMs);
      mostInside = Math.max(mostInside, inside);
    }
    const presentation = compositor.decide(nowMs);
    if (presentation === null) continue;
    const now = new Map(shown.at(-1));
    for (const { source, captureMs, payload } of presentation.items) {
      leave(payload);
      now.set(source, captureMs);
      waitedMs.push(nowMs - (arrivals[payload]?.atMs ?? 0));
    }
    presentations.push({ ...presentation, atMs: nowMs });
    shown.push(now);
  }
  const stats = compositor.stats(lengthMs);
  compositor.clear();
  return { presentations, shown, waitedMs, offered: next, out: out.slice(0, next), mostInside, stats };
}

interface Arrival {
  readonly name: string;
  readonly captureMs: number;
  readonly atMs: number;
}

function arrivalsOf(source: SimulatedSource, lengthMs: number, random: () => number): Arrival[] {
  const { name, intervalMs, phaseMs = 0, delayMs, jitterMs = 0, loss = 0, pauseMs } = source;
  const arrivals: Arrival[] = [];
  let latestMs = 0;
  for (let index = 0; phaseMs + index * intervalMs < lengthMs; index++) {
    const captureMs = phaseMs + index * intervalMs;
    const isPaused = pauseMs !== undefined && captureMs >= pauseMs[0] && captureMs < pauseMs[1];
    if (isPaused || random() < loss) continue;
    latestMs = Math.max(latestMs, captureMs + delayMs + random() * jitterMs);
    arrivals.push({ name, captureMs, atMs: latestMs });
  }
  return arrivals;
}
