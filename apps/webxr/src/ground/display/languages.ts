/** The languages that the page speaks, and which of them an operator gets. */

export const LANGUAGES = ['en', 'de'] as const;
export type Language = (typeof LANGUAGES)[number];

/**
 * The language that was chosen, or else the first of the browser's that the page speaks, or English.
 *
 * @param preferred language tags of RFC 5646, the most wanted first, as in `navigator.languages`
 */
export function languageFor(chosen: Language | 'system', preferred: readonly string[]): Language {
  if (chosen !== 'system') return chosen;
  for (const tag of preferred) {
    const primary = tag.toLowerCase().split('-', 1)[0];
    const found = LANGUAGES.find((known) => known === primary);
    if (found !== undefined) return found;
  }
  return 'en';
}
