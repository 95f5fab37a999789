/**
 * The page's language. All that it says to people stands in one catalogue for each language: English, which is always there, and
 * those that are loaded when a browser asks for them. The type of the English one is what the others must fulfil.
 */
import { signal } from '@preact/signals-core';
import type { Language } from '../ground/display/languages.ts';
import { english, type Texts } from './en/catalogue.ts';

const spoken = signal<{ language: Language; texts: Texts }>({ language: 'en', texts: english });

/** The catalogue that counts now. Read it where a text is made, not when a module is loaded. */
export function texts(): Texts {
  return spoken.value.texts;
}

const catalogues: Readonly<Record<Language, () => Promise<Texts>>> = {
  en: async () => english,
  de: async () => (await import('./de/catalogue.ts')).german,
};

/** The language that is spoken now, as a tag of RFC 5646. */
export function language(): Language {
  return spoken.value.language;
}

/** A text of the catalogue by its place, as the page's HTML names it. @param place `area.key` @throws {Error} if there is none */
export function textAt(place: string): string {
  const [area = '', key = ''] = place.split('.');
  const areas: Readonly<Record<string, Readonly<Record<string, unknown>>>> = texts();
  const text = areas[area]?.[key];
  if (typeof text !== 'string') throw new Error(`no text ${place}`);
  return text;
}

/** Loads a catalogue and speaks that language from now on. @throws {Error} if it cannot be loaded */
export async function speak(wanted: Language): Promise<void> {
  spoken.value = { language: wanted, texts: await catalogues[wanted]() };
}
