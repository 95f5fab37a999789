import type { MappedFile } from '../mapped-file.ts';

export const COUNT_BYTES = 12;

/** A process's counters, in a file that survives it. */
export class Counts {
  readonly #file: MappedFile;

  constructor(file: MappedFile) {
    this.#file = file;
  }

  /** Frames that were read. */
  get frames(): number {
    return this.#file.load32(0);
  }

  /** How many of those were mixtures of two. */
  get torn(): number {
    return this.#file.load32(4);
  }

  /** Files that could not be used as they were. */
  get faults(): number {
    return this.#file.load32(8);
  }

  frame(whole: boolean): void {
    if (!whole) this.#file.store32(4, this.torn + 1);
    this.#file.store32(0, this.frames + 1);
  }

  fault(): void {
    this.#file.store32(8, this.faults + 1);
  }
}
