/**
 * The page's language. All that it says to people stands in one catalogue for each language, of which the page loads the one that it
 * speaks. The type of the English one is what the others must fulfil. What only parts say that are loaded when they are first
 * opened stands in a catalogue of its own, which is loaded with the first of them.
 */
import { signal } from '@preact/signals-core';
import type { Language } from '../ground/display/languages.ts';
import type { Texts } from './en/catalogue.ts';
import type { LaterTexts } from './en/later-catalogue.ts';

interface Spoken {
  readonly language: Language;
  readonly texts: Texts;
  /** `null` until they are loaded. */
  readonly later: LaterTexts | null;
}

const spoken = signal<Spoken | null>(null);

const catalogues: Readonly<
  Record<Language, { texts: () => Promise<Texts>; later: () => Promise<LaterTexts> }>
> = {
  en: {
    texts: async () => (await import('./en/catalogue.ts')).english,
    later: async () => (await import('./en/later-catalogue.ts')).laterEnglish,
  },
  de: {
    texts: async () => (await import('./de/catalogue.ts')).german,
    later: async () => (await import('./de/later-catalogue.ts')).laterGerman,
  },
};

function now(): Spoken {
  if (spoken.value === null) throw new Error('the page’s texts are read before they are loaded');
  return spoken.value;
}

/** The catalogue that counts now. Read it where a text is made, not when a module is loaded. */
export function texts(): Texts {
  return now().texts;
}

/** What parts of the page say that are loaded when they are first opened. Nothing else may read it ({@link loadLaterTexts}). */
export function laterTexts(): LaterTexts {
  const { later } = now();
  if (later === null) throw new Error('the texts of a part are read before they are loaded');
  return later;
}

/** The language that is spoken now, as a tag of RFC 5646. */
export function language(): Language {
  return now().language;
}

/** A text of the catalogue by its place, as the page's HTML names it. @param place `area.key` @throws {Error} if there is none */
export function textAt(place: string): string {
  const [area = '', key = ''] = place.split('.');
  const areas: Readonly<Record<string, Readonly<Record<string, unknown>>>> = texts();
  const text = areas[area]?.[key];
  if (typeof text !== 'string') throw new Error(`no text ${place}`);
  return text;
}

/** Begins to load a catalogue, which {@link speak} then finds loaded. Does nothing if it cannot be loaded. */
export function fetchTexts(wanted: Language): void {
  catalogues[wanted].texts().catch(() => undefined);
}

/** Loads a catalogue and speaks that language from now on. @throws {Error} if it cannot be loaded */
export async function speak(wanted: Language): Promise<void> {
  const hadLater = (spoken.peek()?.later ?? null) !== null;
  const { texts: first, later } = catalogues[wanted];
  const [ofPage, ofParts] = await Promise.all([first(), hadLater ? later() : null]);
  spoken.value = { language: wanted, texts: ofPage, later: ofParts };
}

/** Call it before anything reads {@link laterTexts}. Loads once. @throws {Error} if they cannot be loaded */
export async function loadLaterTexts(): Promise<void> {
  const before = now();
  if (before.later !== null) return;
  const later = await catalogues[before.language].later();
  const after = now();
  if (after.language === before.language) spoken.value = { ...after, later };
}
