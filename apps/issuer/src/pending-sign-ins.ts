/** Sign-ins that have begun, at the provider or at our own question: bounded, and each tied to its browser. Time is an argument. */
import { createHash, timingSafeEqual } from 'node:crypto';
import type { SignInRequest } from '@farpoint/protocol';

/** How long a person may take at the provider. */
export const SIGN_IN_TIME_MS = 600_000;

export interface PendingSignIn {
  request: SignInRequest;
  /** Repeated in the ID token. */
  nonce: string;
  /** Proves to the provider that whoever brings the code began the sign-in (PKCE, RFC 7636). */
  verifier: string;
}

export type TakenSignIn<T = PendingSignIn> =
  | { outcome: 'found' | 'expired'; pending: T }
  /** Never begun, already taken, or dropped. */
  | { outcome: 'unknown' }
  /** Begun in another browser. It goes on there. */
  | { outcome: 'other-browser' };

export class PendingSignIns<T = PendingSignIn> {
  readonly #most: number;
  /** By state, the oldest first. */
  readonly #all = new Map<string, { pending: T; browser: Buffer; beganMs: number }>();

  /** @param most beyond it, the oldest are dropped */
  constructor(most: number) {
    this.#most = most;
  }

  get size(): number {
    return this.#all.size;
  }

  /**
   * @param state names the sign-in at the provider; not guessable
   * @param browser the browser's secret
   */
  add(state: string, browser: string, pending: T, nowMs: number): void {
    for (const [each, { beganMs }] of this.#all) {
      if (nowMs - beganMs < SIGN_IN_TIME_MS && this.#all.size < this.#most) break;
      this.#all.delete(each);
    }
    this.#all.set(state, { pending, browser: digest(browser), beganMs: nowMs });
  }

  /** Ends a sign-in, so that it can be finished only once. */
  take(state: string, browser: string | null, nowMs: number): TakenSignIn<T> {
    const found = this.#all.get(state);
    if (found === undefined) return { outcome: 'unknown' };
    if (browser === null || !timingSafeEqual(found.browser, digest(browser)))
      return { outcome: 'other-browser' };
    this.#all.delete(state);
    return { outcome: nowMs - found.beganMs < SIGN_IN_TIME_MS ? 'found' : 'expired', pending: found.pending };
  }
}

function digest(text: string): Buffer {
  return createHash('sha256').update(text).digest();
}
