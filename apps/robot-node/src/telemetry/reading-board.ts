import type { Reading } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';

/** More topics than a table has. */
const MOST_TOPICS = 64;
/** What nobody has said anew comes again after so long: it may have been lost, or an operator has just come, ms. */
const REPEAT_MS = 2000;

interface Entry {
  reading: TopicReading;
  heardMs: number;
  /** `null` where it was not told since it was heard. */
  toldMs: number | null;
  told: number;
}

/** The newest reading of each topic, and whose turn it is to be told: one at a time, so that they never crowd anything out. */
export class ReadingBoard {
  readonly #entries = new Map<string, Entry>();
  #told = 0;

  add(reading: TopicReading, nowMs: number): void {
    const before = this.#entries.get(reading.topic);
    if (before === undefined && this.#entries.size >= MOST_TOPICS) return;
    this.#entries.set(reading.topic, { reading, heardMs: nowMs, toldMs: null, told: before?.told ?? 0 });
  }

  /** What is to be told now: what has waited longest among what is new, or due again. */
  next(nowMs: number): Reading | null {
    let due: Entry | null = null;
    for (const entry of this.#entries.values()) {
      if (entry.toldMs !== null && nowMs - entry.toldMs < REPEAT_MS) continue;
      if (due === null || entry.told < due.told) due = entry;
    }
    if (due === null) return null;
    due.toldMs = nowMs;
    due.told = ++this.#told;
    return { type: 'reading', ...due.reading, ageMs: Math.max(0, nowMs - due.heardMs) };
  }
}
