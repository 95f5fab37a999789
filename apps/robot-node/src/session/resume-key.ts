import { createHash, randomBytes, timingSafeEqual } from 'node:crypto';

/**
 * What the operator of a session proves by that the session is its own: told to it alone, over the session's own channel. 128
 * random bits.
 */
export class ResumeKey {
  readonly text = randomBytes(16).toString('base64url');
  readonly #digest = digest(this.text);

  /** In a time that tells nothing of the key. */
  matches(text: string): boolean {
    return timingSafeEqual(this.#digest, digest(text));
  }
}

function digest(text: string): Buffer {
  return createHash('sha256').update(text).digest();
}
