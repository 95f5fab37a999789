/** The words of a text, one at a time, so that a long one takes no more memory than itself. */
const WORD = /\S+/g;
const NUMBER = /^[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?$/;
const MOST_CHARACTERS = 64;

export class Words {
  readonly #text: string;
  #at: number;

  constructor(text: string, from = 0) {
    this.#text = text;
    this.#at = from;
  }

  /** `null` at the end; of a long word, its beginning. */
  next(): string | null {
    WORD.lastIndex = this.#at;
    const found = WORD.exec(this.#text);
    if (found === null) return null;
    this.#at = WORD.lastIndex;
    return found[0].slice(0, MOST_CHARACTERS);
  }
}

/** `NaN` for what is no number. */
export function numberOf(word: string | null | undefined): number {
  return word !== null && word !== undefined && NUMBER.test(word) ? Number(word) : Number.NaN;
}
