import { createHash, timingSafeEqual } from 'node:crypto';

/** Tokens read from a file: those valid for a single robot id, and those valid for any. */
export interface TokenSet {
  readonly bound: ReadonlyMap<string, readonly string[]>;
  readonly free: readonly string[];
}

/** Decides who may connect. Stores digests only, and compares all of them in constant time. */
export class AccessList {
  readonly #entries: readonly { digest: Buffer; id: string | null }[];

  /** @param tokens null admits everybody */
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

  /** Whether no token is needed. */
  readonly open: boolean;

  /** Whether the bearer may connect as `id`. `null`: under any id, which every token permits. */
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
