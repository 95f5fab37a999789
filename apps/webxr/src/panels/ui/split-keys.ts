/** Texts in which brackets make a key, as in `Hold [Space] and drive`. */

export interface KeyedPart {
  readonly text: string;
  /** Whether it is the name of a key. */
  readonly isKey: boolean;
}

/** The parts of a text, in its order. What is not closed is no key. */
export function splitKeys(text: string): KeyedPart[] {
  return text
    .split(/(\[[^[\]]+\])/)
    .filter((part) => part !== '')
    .map((part) =>
      part.startsWith('[') && part.endsWith(']')
        ? { text: part.slice(1, -1), isKey: true }
        : { text: part, isKey: false },
    );
}
