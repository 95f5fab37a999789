/** Where a legend's numbers stand beside its colour bar. */
import type { ColourMode } from '@farpoint/cloud-view';
import { fixed } from '../../words/numbers.ts';

export interface Tick {
  /** Share of the bar's length, 0–1. */
  readonly place: number;
  readonly text: string;
}

export interface Quantity {
  readonly unit: string;
  /** The unit's value in the mode's own unit is 1 / this. */
  readonly scale: number;
}

/** Ways to colour points by a value. `captured` and `lit` colours stand for none, and rings are counted. */
export type ValuedMode = Exclude<ColourMode, 'captured' | 'ring' | 'lit'>;

export const QUANTITIES: Readonly<Record<ValuedMode, Quantity>> = {
  height: { unit: 'm', scale: 1 },
  distance: { unit: 'm', scale: 1 },
  intensity: { unit: '%', scale: 100 },
  age: { unit: 'ms', scale: 1000 },
};

export function isValued(mode: ColourMode): mode is ValuedMode {
  return mode in QUANTITIES;
}

/**
 * Round numbers within a range, at most `most` of them.
 *
 * @param min less than `max`
 */
export function ticksOf(min: number, max: number, most = 5): Tick[] {
  const span = max - min;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const least = span / most;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9)) ?? 10);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const ticks: Tick[] = [];
  for (let i = Math.ceil(min / step - 1e-9); i * step <= max + step * 1e-9; i++) {
    // Not "-0".
    const value = i === 0 ? 0 : i * step;
    ticks.push({ place: (value - min) / span, text: fixed(value, digits) });
  }
  return ticks.length > most ? ticks.filter((_, i) => i % 2 === 0) : ticks;
}
