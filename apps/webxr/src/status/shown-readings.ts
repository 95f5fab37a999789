/** The robot's readings as the page shows them. */
import type { AgedReading } from '@farpoint/operator';
import type { ReadingLevel } from '@farpoint/protocol';
import type { Tone } from './words.ts';

export interface ShownReading {
  topic: string;
  label: string;
  text: string;
  tone: Tone;
}

/** From this age on, the text includes the reading's age, ms. */
const OLD_MS = 10_000;

const tones: Record<ReadingLevel, Tone> = { ok: 'neutral', warn: 'warning', error: 'bad' };

export function shownReading({ reading, ageMs }: AgedReading): ShownReading {
  const { topic, label, level, values } = reading;
  const text = values.map(([name, value]) => (name === '' ? value : `${name}: ${value}`)).join(' · ');
  const old = ageMs > OLD_MS;
  return {
    ...{ topic, label },
    text: old ? `${text} (${Math.round(ageMs / 1000)} s ago)` : text,
    tone: old && level === 'ok' ? 'warning' : tones[level],
  };
}
