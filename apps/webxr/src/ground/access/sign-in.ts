/** Signing in for a grant. The browser leaves the page for it, so the page remembers what it asked for. */
import { handleSchema, signInAddress } from '@farpoint/protocol';
import * as z from 'zod/mini';

const KEY = 'farpoint.sign-in';

const schema = z.object({ state: handleSchema, service: z.string().check(z.maxLength(512)) });

/** `sessionStorage`, which no other tab reads. */
export type TabStorage = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

export class SignIn {
  readonly #storage: TabStorage;
  readonly #service: string;

  /** @param service origin of the signaling service, whose operators' key the grant is for */
  constructor(storage: TabStorage, service: string) {
    this.#storage = storage;
    this.#service = service;
  }

  /**
   * Remembers that the page asks.
   *
   * @param key thumbprint of the operator's own key
   * @param page the page's address
   * @param state not guessable; the issuer's answer repeats it
   * @returns where the browser is to go
   */
  begin(signInUrl: string, key: string, page: string, state: string): string {
    this.#storage.setItem(KEY, JSON.stringify({ state, service: this.#service }));
    return signInAddress(signInUrl, { key, return: withoutSecrets(page), state });
  }

  /** Whether this answers what the page asked for here. Each question is answered once. */
  isAnsweredBy(state: string | null): boolean {
    const text = this.#storage.getItem(KEY);
    this.#storage.removeItem(KEY);
    let value: unknown = null;
    try {
      value = JSON.parse(text ?? 'null');
    } catch {
      return false;
    }
    const { data } = schema.safeParse(value);
    return data !== undefined && state !== null && data.state === state && data.service === this.#service;
  }
}

/** The page's address as the issuer may see it. */
function withoutSecrets(page: string): string {
  const url = new URL(page);
  url.hash = '';
  url.searchParams.delete('token');
  return url.href;
}

/** The tab's storage; where the browser denies it, nothing is remembered, and grants that come are only offered. */
export function tabStorage(): TabStorage {
  try {
    return window.sessionStorage;
  } catch {
    return { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };
  }
}
