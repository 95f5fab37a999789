import { createHash, timingSafeEqual } from 'node:crypto';

/** Tokens as read from a file: those good for one robot id, and those good for any. */
export interface TokenSet {
  readonly bound: ReadonlyMap<string, readonly string[]>;
  readonly free: readonly string[];
}

/** Decides who may come in. Keeps digests only, and compares every one of them in constant time. */
export class AccessList {
  readonly #entries: readonly { digest: Buffer; id: string | null }[];

  /** @param tokens null lets everybody in */
  constructor(tokens: TokenSet | null) {
    this.#entries =
      tokens === null
        ? []
        : [
            ...[...tokens.bound].flatMap(([id, list]) =>
              list.map((token) => ({ digest: digest(token), id })),
            ),
            ...tokens.free.map((token) => ({ digest: digest(token), id: null })),
          ];
    this.open = tokens === null;
  }

  /** Nobody needs a token. */
  readonly open: boolean;

  /** May the bearer come in as `id`? `null`: as anybody, which any token allows. */
  allows(token: string | undefined, id: string | null): boolean {
    if (this.open) return true;
    if (token === undefined) return false;
    const given = digest(token);
    let allowed = false;
    for (const entry of this.#entries) {
      const same = timingSafeEqual(given, entry.digest);
      if (same && (id === null || entry.id === null || entry.id === id)) allowed = true;
    }
    return allowed;
  }
}

function digest(token: string): Buffer {
  return createHash('sha256').update(token).digest();
}
