/** What has happened on this page, the newest last: a bounded list. Pure: time is passed in. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { Tone, Words } from '../status/tone.ts';

export const SEVERITIES = ['info', 'warning', 'error'] as const;
export type Severity = (typeof SEVERITIES)[number];

export interface PageEvent {
  /** When it happened, and when it happened again last: ms since the epoch. */
  readonly atMs: number;
  readonly lastMs: number;
  /** How often it happened. */
  readonly times: number;
  /** The robot's name, or its id while it has not said its name; `null` if it is about none. */
  readonly robot: string | null;
  readonly severity: Severity;
  readonly text: string;
}

export interface KeptEvents {
  /** The oldest first. */
  readonly events: readonly PageEvent[];
  /** How many older ones have been dropped. */
  readonly dropped: number;
}

export const MOST_EVENTS = 1000;
/** Longer texts are cut. */
export const MOST_TEXT = 600;
/** What happens again within this time is counted, ms. */
export const AGAIN_MS = 10_000;
/** Among so many of the newest. */
const AGAIN_AMONG = 12;

const NOTHING: KeptEvents = { events: [], dropped: 0 };
const severityOf: Readonly<Record<Tone, Severity>> = {
  good: 'info',
  neutral: 'info',
  warning: 'warning',
  bad: 'error',
};

export class EventLog {
  readonly #kept = signal<KeptEvents>(NOTHING);
  readonly #epochMs: () => number;
  /** How many events may still be counted again. */
  #sinceMark = 0;

  /** @param epochMs milliseconds since the epoch */
  constructor(epochMs: () => number) {
    this.#epochMs = epochMs;
  }

  get kept(): ReadonlySignal<KeptEvents> {
    return this.#kept;
  }

  /**
   * What may happen again and again: within the next seconds it is counted there, with its newest numbers.
   *
   * @param robot its name or id; `null` if this is about none
   */
  add(words: Words, robot: string | null): void {
    const event = this.#eventOf(words, robot);
    const { events, dropped } = this.#kept.peek();
    const pattern = patternOf(event.text);
    const again = events.findLastIndex(
      (before, index) =>
        index >= events.length - Math.min(this.#sinceMark, AGAIN_AMONG) &&
        event.atMs - before.lastMs <= AGAIN_MS &&
        before.robot === robot &&
        before.severity === event.severity &&
        patternOf(before.text) === pattern,
    );
    const before = events[again];
    if (before === undefined) {
      this.#sinceMark++;
      this.#keep([...events, event], dropped);
      return;
    }
    const counted = events.slice();
    counted[again] = { ...event, atMs: before.atMs, times: before.times + 1 };
    this.#kept.value = { events: counted, dropped };
  }

  /** What has its place among all others: it is never counted elsewhere, and nothing after it before it. */
  mark(words: Words, robot: string | null): void {
    const { events, dropped } = this.#kept.peek();
    this.#sinceMark = 0;
    this.#keep([...events, this.#eventOf(words, robot)], dropped);
  }

  /** Puts what was kept of an earlier visit before everything else. */
  restore({ events, dropped }: KeptEvents): void {
    const now = this.#kept.peek();
    this.#keep([...events, ...now.events], dropped + now.dropped);
  }

  /** Only the operator asks for this. */
  clear(): void {
    this.#kept.value = NOTHING;
  }

  #eventOf({ text, tone }: Words, robot: string | null): PageEvent {
    const nowMs = this.#epochMs();
    const severity = severityOf[tone];
    return { atMs: nowMs, lastMs: nowMs, times: 1, robot, severity, text: text.slice(0, MOST_TEXT) };
  }

  #keep(events: readonly PageEvent[], dropped: number): void {
    const over = Math.max(events.length - MOST_EVENTS, 0);
    this.#kept.value = { events: events.slice(over), dropped: dropped + over };
  }
}

/** Texts that differ in their numbers only tell of the same. */
export function patternOf(text: string): string {
  return text.replaceAll(/\d+(?:[.,]\d+)*/g, '#');
}
