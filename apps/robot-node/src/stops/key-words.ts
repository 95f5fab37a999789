/** What keys typed at the robot's console mean. */

const RELEASE = 'release';
const CTRL_C = 0x03;
const LINE_FEED = 0x0a;
const RETURN = 0x0d;

export type KeyWord = 'stop' | 'release' | 'interrupt';

/** Every key stops, except those that spell `release`, which with Enter releases. Ctrl+C ends the program as ever. */
export class KeyWords {
  #typed = '';
  #wasReturn = false;

  /** @param byte as the console sends it @returns `null` if it means nothing yet */
  take(byte: number): KeyWord | null {
    const endsLine = byte === RETURN || byte === LINE_FEED;
    // One Enter, if it comes as two bytes.
    const isRepeat = byte === LINE_FEED && this.#wasReturn;
    this.#wasReturn = byte === RETURN;
    if (isRepeat) return null;
    const typed = this.#typed;
    this.#typed = '';
    if (byte === CTRL_C) return 'interrupt';
    if (endsLine) return typed === RELEASE ? 'release' : 'stop';
    const longer = typed + String.fromCharCode(byte);
    if (!RELEASE.startsWith(longer)) return 'stop';
    this.#typed = longer;
    return null;
  }
}
