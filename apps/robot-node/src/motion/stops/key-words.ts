/** What keys typed at the robot's console mean. */

const RELEASE = 'release';
const CTRL_C = 0x03;
const LINE_FEED = 0x0a;
const RETURN = 0x0d;

export type KeyWord = 'stop' | 'release' | 'interrupt';

/** Every key stops, also those that spell `release`; the Enter that completes it releases. Ctrl+C ends the program. */
export class KeyWords {
  /** The last keys, as many as the word has. */
  #typed = '';

  /** @param bytes as the console sends them at once @returns what each key says, in order */
  take(bytes: Uint8Array): KeyWord[] {
    const words: KeyWord[] = [];
    let last = 0;
    for (const byte of bytes) {
      // One Enter, if it comes as two bytes. Later, a line feed is a key of its own.
      const isRepeat = byte === LINE_FEED && last === RETURN;
      last = byte;
      if (!isRepeat) words.push(this.#key(byte));
    }
    return words;
  }

  #key(byte: number): KeyWord {
    const typed = this.#typed;
    this.#typed = '';
    if (byte === CTRL_C) return 'interrupt';
    if (byte === RETURN || byte === LINE_FEED) return typed === RELEASE ? 'release' : 'stop';
    this.#typed = `${typed}${String.fromCharCode(byte)}`.slice(-RELEASE.length);
    // Whoever begins the word may as well have hit the key in alarm.
    return 'stop';
  }
}
