/**
 * Numbers as the page's language writes them. For what is shown to people only: files that are saved keep the point. Figures are
 * written several times a second, so a format is made once for each language.
 */
import type { Language } from '../ground/display/languages.ts';
import { language, texts } from './language.ts';

const inThousands: Partial<Record<Language, Intl.NumberFormat>> = {};
const dates: Partial<Record<Language, Intl.DateTimeFormat>> = {};

/** With so many digits after the decimal mark, as in `0.38` and `0,38`. */
export function fixed(value: number, digits: number): string {
  return marked(value.toFixed(digits));
}

/** A number that was written with a decimal point, with the language's mark. */
export function marked(number: string): string {
  const mark = texts().measures.decimalMark;
  return mark === '.' ? number : number.replace('.', mark);
}

/** Whole, as in `12,000` and `12.000`. */
export function grouped(value: number): string {
  const now = language();
  inThousands[now] ??= new Intl.NumberFormat(now, { maximumFractionDigits: 0 });
  return inThousands[now].format(value);
}

/** A share, 0–1, in whole percent. */
export function percent(share: number): string {
  return `${Math.round(share * 100)} %`;
}

/** Day and time of day. @param ms since 1970 */
export function dateText(ms: number): string {
  const now = language();
  dates[now] ??= new Intl.DateTimeFormat(now, { dateStyle: 'medium', timeStyle: 'short' });
  return dates[now].format(ms);
}
