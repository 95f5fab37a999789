/** A single peer's interfaces and NATs never need more addresses than this. */
const MAX_SOURCES = 32;

/** The addresses that sent authentic connectivity checks. When full, the oldest is dropped. */
export class KnownSources {
  readonly #known = new Set<string>();
  /** Cached, because data comes from the same address again and again. */
  #lastHost = '';
  #lastPort = -1;

  add(host: string, port: number): void {
    const key = `${host} ${port}`;
    if (this.#known.has(key)) return;
    this.#known.add(key);
    if (this.#known.size <= MAX_SOURCES) return;
    this.#known.delete(this.#known.values().next().value as string);
    this.#lastPort = -1;
  }

  has(host: string, port: number): boolean {
    if (port === this.#lastPort && host === this.#lastHost) return true;
    if (!this.#known.has(`${host} ${port}`)) return false;
    this.#lastHost = host;
    this.#lastPort = port;
    return true;
  }
}
