import { encodeJsonBytes, type ServiceToOperator, serviceToOperatorCodec } from '@farpoint/protocol';
import type { ListingSource } from './listing-feed.ts';

/** How a list and its changes are said. */
export interface ListingWords<Entry> {
  whole(entries: Iterable<Entry>): ServiceToOperator;
  changed(here: readonly Entry[], gone: string[]): ServiceToOperator;
}

/** A list by id as messages, and the changes since any recent version. */
export class VersionedListing<Entry> implements ListingSource {
  readonly #entries: ReadonlyMap<string, Entry>;
  readonly #words: ListingWords<Entry>;
  readonly #remembered: number;
  /** Ids in the order of their changes: index i led to version `#oldest + i + 1`. */
  #changes: string[] = [];
  #oldest = 0;
  #whole: Uint8Array | null = null;
  /** Encoded once for all operators with the same version. */
  readonly #since = new Map<number, Uint8Array>();

  /**
   * @param entries read whenever a message is made
   * @param remembered number of changes to keep; an operator that is further behind gets the whole list
   */
  constructor(entries: ReadonlyMap<string, Entry>, words: ListingWords<Entry>, remembered = 1024) {
    this.#entries = entries;
    this.#words = words;
    this.#remembered = remembered;
  }

  get version(): number {
    return this.#oldest + this.#changes.length;
  }

  /** Call this when an entry was added or removed, or says something else. */
  changed(id: string): void {
    this.#changes.push(id);
    // Half of the changes are dropped at once, so that the cost of a change does not depend on how many are kept.
    if (this.#changes.length > 2 * this.#remembered) {
      this.#oldest += this.#changes.length - this.#remembered;
      this.#changes = this.#changes.slice(-this.#remembered);
    }
    this.#whole = null;
    this.#since.clear();
  }

  /** The whole list. */
  whole(): Uint8Array {
    this.#whole ??= encode(this.#words.whole(this.#entries.values()));
    return this.#whole;
  }

  /** The changes that update a list of this version, or the whole list if the version is too old. */
  since(version: number): Uint8Array {
    if (version < this.#oldest) return this.whole();
    let message = this.#since.get(version);
    if (message === undefined) {
      const here: Entry[] = [];
      const gone: string[] = [];
      for (const id of new Set(this.#changes.slice(version - this.#oldest))) {
        const entry = this.#entries.get(id);
        if (entry === undefined) gone.push(id);
        else here.push(entry);
      }
      message = encode(this.#words.changed(here, gone));
      this.#since.set(version, message);
    }
    return message;
  }
}

function encode(message: ServiceToOperator): Uint8Array {
  return encodeJsonBytes<ServiceToOperator>(serviceToOperatorCodec, message);
}
