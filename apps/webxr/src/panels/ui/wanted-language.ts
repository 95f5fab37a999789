/**
 * The language that was chosen, or else the browser's. A page imports this module before all others: its texts are on their way
 * then while the rest of the code is still compiled, and not only after it.
 */
import { type Language, languageFor } from '../../ground/display/languages.ts';
import { displaySettings } from '../../ground/display/stored-display.ts';
import { fetchTexts } from '../../words/language.ts';

// Fetched beside the evaluation of all other modules, which takes a small machine some 100 ms.
fetchTexts(wantedLanguage());

/** By the present settings: another than is spoken, once they have changed. */
export function wantedLanguage(): Language {
  return languageFor(displaySettings.peek().language, navigator.languages);
}
