/** What the robot's sensors and topics say, as the page shows it. */
import type { Reading, ReadingLevel } from '@farpoint/protocol';
import type { Tone } from '../status/words.ts';

export interface ShownReading {
  topic: string;
  label: string;
  text: string;
  tone: Tone;
}

/** A robot has no more topics for people. */
const MOST_TOPICS = 64;
/** From then on people are told how old it is, ms. */
const OLD_MS = 10_000;

const tones: Record<ReadingLevel, Tone> = { ok: 'neutral', warn: 'warning', error: 'bad' };

export class Readings {
  readonly #newest = new Map<string, { reading: Reading; heardMs: number }>();

  /** @param nowMs the page's clock. Unordered: one that is older than what is known tells nothing */
  take(reading: Reading, nowMs: number): void {
    const heardMs = nowMs - reading.ageMs;
    const before = this.#newest.get(reading.topic);
    if (before === undefined && this.#newest.size >= MOST_TOPICS) return;
    // The way here is not always as long: half a second is none.
    if (before !== undefined && heardMs < before.heardMs - 500) return;
    this.#newest.set(reading.topic, { reading, heardMs });
  }

  /** In the order in which they came first. */
  list(nowMs: number): ShownReading[] {
    return [...this.#newest.values()].map(({ reading, heardMs }) => {
      const { topic, label, level, values } = reading;
      const text = values.map(([name, value]) => (name === '' ? value : `${name}: ${value}`)).join(' · ');
      const ageMs = nowMs - heardMs;
      const old = ageMs > OLD_MS;
      return {
        ...{ topic, label },
        text: old ? `${text} (${Math.round(ageMs / 1000)} s ago)` : text,
        tone: old && level === 'ok' ? 'warning' : tones[level],
      };
    });
  }
}
