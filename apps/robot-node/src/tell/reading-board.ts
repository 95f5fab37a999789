import type { Reading } from '@farpoint/protocol';
import { MOST_TOPICS, type TopicReading } from '@farpoint/ros';

/**
 * A reading without an update is sent again after this long: it may have been lost, or a new operator may have
 * connected, ms.
 */
const REPEAT_MS = 2000;

interface Entry {
  reading: TopicReading;
  heardMs: number;
  /** `null` if it has not been sent since it was received. */
  toldMs: number | null;
  told: number;
}

/**
 * Keeps the newest reading of each topic, and decides which one to send next. Readings are sent one at a time, so
 * that they never crowd out anything else.
 */
export class ReadingBoard {
  readonly #entries = new Map<string, Entry>();
  #told = 0;

  add(reading: TopicReading, nowMs: number): void {
    const before = this.#entries.get(reading.topic);
    if (before === undefined && this.#entries.size >= MOST_TOPICS) return;
    this.#entries.set(reading.topic, {
      reading,
      heardMs: reading.measuredMs ?? nowMs,
      toldMs: null,
      told: before?.told ?? 0,
    });
  }

  /** The reading to send now: the one that has waited longest among those that are new or due again. */
  next(nowMs: number): Reading | null {
    let due: Entry | null = null;
    for (const entry of this.#entries.values()) {
      if (entry.toldMs !== null && nowMs - entry.toldMs < REPEAT_MS) continue;
      if (due === null || entry.told < due.told) due = entry;
    }
    if (due === null) return null;
    due.toldMs = nowMs;
    due.told = ++this.#told;
    const { topic, label, level, values } = due.reading;
    const ageMs = Math.max(0, nowMs - due.heardMs);
    return { type: 'reading', topic, label, level, values, ageMs, timeMs: due.heardMs };
  }
}
