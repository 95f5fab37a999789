/** The encoded pictures of the last while, in memory that is bounded in time and in bytes. Pure. */

export interface ClipPicture {
  /** Whether it can be decoded without any before it. */
  readonly key: boolean;
  readonly timestampUs: number;
  readonly bytes: Uint8Array;
}

export interface ClipLimits {
  /** At least so much is kept, seconds, and at most one group of pictures more. */
  readonly seconds: number;
  /** All groups but the newest go before this is exceeded. */
  readonly mostBytes: number;
}

/** A picture that needs no other, and those that need it. */
interface Group {
  readonly pictures: ClipPicture[];
  bytes: number;
}

export class ClipRing {
  readonly #limits: ClipLimits;
  readonly #groups: Group[] = [];
  #bytes = 0;

  constructor(limits: ClipLimits) {
    this.#limits = limits;
  }

  get bytes(): number {
    return this.#bytes;
  }

  /** A picture that needs others is dropped while there is no group. */
  add(picture: ClipPicture): void {
    if (picture.key) this.#groups.push({ pictures: [], bytes: 0 });
    const group = this.#groups.at(-1);
    if (group === undefined) return;
    group.pictures.push(picture);
    group.bytes += picture.bytes.length;
    this.#bytes += picture.bytes.length;
    while (this.#groups.length > 1 && this.#isTooMuch(picture.timestampUs)) {
      const oldest = this.#groups.shift();
      this.#bytes -= oldest?.bytes ?? 0;
    }
  }

  /** Everything that is kept, in order, from a key picture on. */
  get pictures(): readonly ClipPicture[] {
    return this.#groups.flatMap(({ pictures }) => pictures);
  }

  clear(): void {
    this.#groups.length = 0;
    this.#bytes = 0;
  }

  #isTooMuch(newestUs: number): boolean {
    const { seconds, mostBytes } = this.#limits;
    const second = this.#groups[1]?.pictures[0];
    const isLong = second !== undefined && newestUs - second.timestampUs >= seconds * 1e6;
    return isLong || this.#bytes > mostBytes;
  }
}
