/** One reader of bytes from outside. */
export interface FuzzTarget {
  readonly name: string;
  /** Valid inputs and others that get far: what is mutated. */
  readonly seeds: () => readonly Uint8Array[] | Promise<readonly Uint8Array[]>;
  /**
   * Reads the input as the programs do. Returns without a value, or a promise for readers of files.
   *
   * @throws errors of the types in `refusals`, and no others
   */
  readonly run: (input: Uint8Array) => void | Promise<void>;
  /** Names of the errors with which it may refuse. */
  readonly refusals: readonly string[];
  /** How many inputs it gets for one of the others; 1 if undefined. Readers of whole files are slow. */
  readonly share?: number;
  /** Longest input, bytes; 2,048 if undefined. */
  readonly maxBytes?: number;
}
