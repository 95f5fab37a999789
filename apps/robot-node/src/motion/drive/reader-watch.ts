/** Whether the program that reads the command block still reads it. Pure: time is an argument. */

/**
 * A reader that follows the counter reads at least this often, ms. Chosen: twice the 150 ms of the watchdog.
 */
export const READER_SILENT_MS = 300;
/** How many writes a reader may be behind. */
const MOST_BEHIND = 16;

/**
 * Watches the byte in which a reader repeats the counter's lowest byte. A byte that stands still, or that has nothing
 * to do with the counter, is no sign of life: readers that predate the byte leave it alone.
 */
export class ReaderWatch {
  readonly #isRequired: boolean;
  #echo: number | null = null;
  #heardMs: number | null = null;

  /** @param isRequired whether a reader that has never answered counts as absent */
  constructor(isRequired: boolean) {
    this.#isRequired = isRequired;
  }

  /**
   * @param echo the byte, 0 to 255
   * @param counter of the newest write
   */
  note(echo: number, counter: number, nowMs: number): void {
    const hasChanged = this.#echo !== null && echo !== this.#echo;
    this.#echo = echo;
    if (hasChanged && ((counter - echo) & 0xff) <= MOST_BEHIND) this.#heardMs = nowMs;
  }

  /** True while the reader is known to be away. */
  isSilent(nowMs: number): boolean {
    if (this.#heardMs === null) return this.#isRequired;
    return nowMs - this.#heardMs > READER_SILENT_MS;
  }
}
