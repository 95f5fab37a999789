/**
 * All that the page says, in English, by area. A text is a string, or a function of what it names; a table by a value of the
 * protocol must be complete (`satisfies Record<…>`). Modules in `words/` decide which text is said, and know no language.
 */
import { driving } from './driving.ts';

export const english = {
  driving,
};

/** What a catalogue of any language has. */
export type Texts = typeof english;
