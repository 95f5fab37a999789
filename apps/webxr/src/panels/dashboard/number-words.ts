/** Numbers with units, and ages, for people. */

import { fixed, marked } from '../../words/numbers.ts';

/** Digits after the point that say something, by unit. */
const DIGITS: Readonly<Record<string, number>> = {
  'm/s': 2,
  '°/s': 0,
  '°': 0,
  '%': 0,
  V: 1,
  A: 1,
  '°C': 1,
  m: 2,
};
/** Latitudes and longitudes: a millionth of a degree is a decimetre. */
const FIX_DIGITS = 6;

/** Without the unit. */
export function numberText(value: number, unit: string): string {
  const known = DIGITS[unit];
  if (known !== undefined) return marked(withoutMinusZero(value.toFixed(known)));
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return marked(value.toExponential(2));
  const digits = Math.max(0, 3 - Math.max(0, Math.floor(Math.log10(size))));
  return marked(withoutMinusZero(value.toFixed(digits)));
}

export function withUnit(value: number, unit: string): string {
  const text = numberText(value, unit);
  if (unit === '') return text;
  return unit === '°' ? `${text}°` : `${text} ${unit}`;
}

export function fixText(latitude: number, longitude: number): string {
  return `${fixed(latitude, FIX_DIGITS)}°, ${fixed(longitude, FIX_DIGITS)}°`;
}

/** An age in words. */
export function ageText(ageMs: number): string {
  const seconds = ageMs / 1000;
  if (seconds < 1) return `${Math.round(ageMs / 10) * 10} ms`;
  if (seconds < 10) return `${fixed(seconds, 1)} s`;
  if (seconds < 120) return `${Math.round(seconds)} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}

/** A length of time that was chosen. */
export function spanText(seconds: number): string {
  return seconds < 60 ? `${seconds} s` : seconds < 3600 ? `${seconds / 60} min` : `${seconds / 3600} h`;
}

function withoutMinusZero(text: string): string {
  return Number(text) === 0 ? text.replace('-', '') : text;
}
