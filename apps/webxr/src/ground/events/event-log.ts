/** What has happened on this page: a bounded list, the newest last. Pure: time is passed in. */
import { TokenBucket } from '@farpoint/timing';
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { repetitionKey } from './event-table.ts';
import { bounded, type EventDetail, MOST_TEXT, type PageEvent } from './page-event.ts';

/** Chosen: the events of a shift of eight hours, at four a minute, in about half a megabyte; event-log.test.ts holds it. */
export const MOST_EVENTS = 2000;
/** What happens again within this time is counted, ms. Chosen: a refusal comes with each command; event-log.test.ts holds it. */
export const AGAIN_MS = 10_000;
/** It is looked for among so many of the newest. Chosen: several things that repeat at once; event-log.test.ts holds it. */
const AGAIN_AMONG = 12;
/**
 * Entries a second, and at once. Chosen: a robot that says something else with each message cannot push out what happened
 * before it within less than three minutes; event-log.test.ts holds it.
 */
const RATE = { perSecond: 5, burst: 100 };

export interface KeptEvents {
  /** The oldest first. */
  readonly events: readonly PageEvent[];
  /** How many older ones have been dropped. */
  readonly dropped: number;
}

/** Whom an event concerns. */
export interface EventSubject {
  /** Name or id; `null` if it concerns no robot. */
  readonly robot: string | null;
  /** How long the session has lasted, ms; `null` without one. */
  readonly sessionMs: number | null;
}

export class EventLog {
  /** Called for all that happens, also what is only counted or suppressed. */
  onEvent: ((detail: EventDetail, times: number) => void) | null = null;
  readonly #epochMs: () => number;
  readonly #revision = signal(0);
  readonly #rate = new TokenBucket(RATE);
  readonly #events: PageEvent[] = [];
  #dropped = 0;
  #suppressed = 0;
  /** How many of the newest may still be counted again. */
  #sinceMark = 0;

  /** @param epochMs milliseconds since the epoch, now */
  constructor(epochMs: () => number) {
    this.#epochMs = epochMs;
  }

  /** Another number whenever something has changed. */
  get revision(): ReadonlySignal<number> {
    return this.#revision;
  }

  get kept(): KeptEvents {
    return { events: this.#events, dropped: this.#dropped };
  }

  /**
   * Adds what has happened, or counts it in an entry of the last seconds that says the same.
   *
   * @param times how often it has happened
   */
  add(said: EventDetail, { robot: named, sessionMs }: EventSubject, times = 1): void {
    const detail = bounded(said);
    this.onEvent?.(detail, times);
    const nowMs = this.#epochMs();
    const robot = named?.slice(0, MOST_TEXT) ?? null;
    if (this.#count(detail, robot, nowMs, times)) return;
    if (!this.#rate.take(nowMs)) {
      this.#suppressed++;
      return;
    }
    const made = { atMs: nowMs, lastMs: nowMs, sessionMs, robot };
    if (this.#suppressed > 0) {
      const count = this.#suppressed;
      this.#suppressed = 0;
      this.#push({ ...made, times: 1, detail: { kind: 'suppressed', count } });
    }
    this.#push({ ...made, times, detail });
  }

  /** Puts what was kept of an earlier visit before everything else. */
  restore({ events, dropped }: KeptEvents): void {
    this.#events.unshift(...events);
    this.#dropped += dropped;
    this.#trim();
  }

  /** Forgets everything. Only the operator asks for this. */
  clear(): void {
    this.#events.length = 0;
    this.#dropped = 0;
    this.#sinceMark = 0;
    this.#trim();
  }

  /** @returns whether there was an entry to count it in */
  #count(detail: EventDetail, robot: string | null, nowMs: number, times: number): boolean {
    const key = repetitionKey(detail);
    if (key === null) return false;
    const { length } = this.#events;
    const among = Math.min(this.#sinceMark, AGAIN_AMONG);
    for (let i = length - 1; i >= length - among; i--) {
      const before = this.#events[i];
      if (before === undefined || before.robot !== robot || nowMs - before.lastMs > AGAIN_MS) continue;
      if (repetitionKey(before.detail) !== key) continue;
      // The newest numbers count.
      this.#events[i] = { ...before, lastMs: nowMs, times: before.times + times, detail };
      this.#revision.value++;
      return true;
    }
    return false;
  }

  /** What has its own place among the others: nothing after it is counted before it. */
  #push(event: PageEvent): void {
    this.#sinceMark = repetitionKey(event.detail) === null ? 0 : this.#sinceMark + 1;
    this.#events.push(event);
    this.#trim();
  }

  #trim(): void {
    const over = Math.max(this.#events.length - MOST_EVENTS, 0);
    this.#events.splice(0, over);
    this.#dropped += over;
    this.#revision.value++;
  }
}
