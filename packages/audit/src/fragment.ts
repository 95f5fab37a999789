import { createHash, type Hash } from 'node:crypto';

const NEWLINE = Uint8Array.of(0x0a);

/** How a `torn-entry` describes the bytes before it. */
export interface FragmentDescription {
  readonly bytes: number;
  readonly sha256: string;
}

/** Bytes in a log that are no entry: what a program left that ended while it wrote. */
export class Fragment {
  readonly #hash: Hash = createHash('sha256');
  #bytes = 0;
  #newlineDue = false;

  /** Adds bytes of a line. */
  add(bytes: Uint8Array): void {
    this.#addNewline();
    this.#hash.update(bytes);
    this.#bytes += bytes.byteLength;
  }

  /** The line has ended. */
  endLine(): void {
    this.#addNewline();
    this.#newlineDue = true;
  }

  /**
   * Whether this is what the description says. The last newline is the fragment's own, or was added after it to begin
   * a new line.
   */
  is(description: FragmentDescription): boolean {
    const { bytes, sha256 } = description;
    if (bytes === this.#bytes) return this.#hash.copy().digest('hex') === sha256;
    const ended = this.#newlineDue && bytes === this.#bytes + 1;
    return ended && this.#hash.copy().update(NEWLINE).digest('hex') === sha256;
  }

  #addNewline(): void {
    if (!this.#newlineDue) return;
    this.#hash.update(NEWLINE);
    this.#bytes++;
    this.#newlineDue = false;
  }
}
