import type { SignInError } from '@farpoint/protocol';

/** Nobody is signed in. */
export class SignInRefusedError extends Error {
  override readonly name = 'SignInRefusedError';
  readonly reason: SignInError;

  /** @param detail for the log; it names no token or code */
  constructor(reason: SignInError, detail: string) {
    super(detail);
    this.reason = reason;
  }
}
