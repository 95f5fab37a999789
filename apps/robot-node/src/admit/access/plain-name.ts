/** The name of an operator as others are shown it. */

/** Marks that turn the direction of text round, or break its line: they would make a name look like another's. */
const MARKS = /[\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\p{Cc}]/gu;
/** Longest name in a message: displayNameSchema. */
const MOST_LETTERS = 64;

/**
 * The name without what would change how the text around it is read. Half a surrogate pair would take six characters of a
 * message, so that the longest list would not fit. @returns 1 to 64 characters
 */
export function plainName(name: string): string {
  const plain = name.toWellFormed().replace(MARKS, '').slice(0, MOST_LETTERS).toWellFormed().trim();
  return plain === '' ? '?' : plain;
}
