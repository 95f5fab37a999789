/** The robot's readings as the page shows them. */
import type { AgedReading } from '@farpoint/operator';
import type { ReadingLevel } from '@farpoint/protocol';
import { texts } from './language.ts';
import type { Tone } from './words.ts';

export interface ShownReading {
  topic: string;
  label: string;
  text: string;
  tone: Tone;
}

/**
 * From this age on, the text includes the reading's age, unless the topic's own rate is known, ms. Chosen:
 * five of the robot's repetitions (reading-board.ts).
 */
const OLD_MS = 10_000;
/** With a known rate: after so many intervals; at least and at most, ms. Readings take turns on the way here. */
const OLD_INTERVALS = 3;
const LEAST_OLD_MS = 5000;
const MOST_OLD_MS = 60_000;

const tones: Record<ReadingLevel, Tone> = { ok: 'neutral', warn: 'warning', error: 'bad' };

export function shownReading({ reading, ageMs, intervalMs }: AgedReading): ShownReading {
  const { topic, label, level, values } = reading;
  const text = values.map(([name, value]) => (name === '' ? value : `${name}: ${value}`)).join(' · ');
  const oldMs =
    intervalMs === null ? OLD_MS : Math.min(Math.max(OLD_INTERVALS * intervalMs, LEAST_OLD_MS), MOST_OLD_MS);
  const old = ageMs > oldMs;
  return {
    topic,
    label,
    text: old ? texts().figures.ago(text, Math.round(ageMs / 1000)) : text,
    tone: old && level === 'ok' ? 'warning' : tones[level],
  };
}
