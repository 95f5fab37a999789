import { createHash, randomBytes, timingSafeEqual } from 'node:crypto';

/**
 * With this key an operator proves that a session is its own. The robot sends it to that operator only, over the
 * session's own channel. 128 random bits.
 */
export class ResumeKey {
  readonly text = randomBytes(16).toString('base64url');
  readonly #digest = digest(this.text);

  /** Compares in constant time, so that the duration reveals nothing about the key. */
  matches(text: string): boolean {
    return timingSafeEqual(this.#digest, digest(text));
  }
}

function digest(text: string): Buffer {
  return createHash('sha256').update(text).digest();
}
