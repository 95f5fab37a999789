/** A topic whose messages are shown to people, live or recorded. */
import {
  BatteryGauge,
  DiagnosticBoard,
  numbersOf,
  RateLimit,
  readingOf,
  type TopicEntry,
  type TopicReading,
  type TopicRole,
} from '@farpoint/ros';

const READING_ROLES: readonly TopicRole[] = ['battery', 'fix', 'diagnostics', 'text'];

export class ReadingTopic {
  readonly #entry: TopicEntry;
  readonly #board: DiagnosticBoard | null;
  readonly #limit: RateLimit;
  readonly #gauge = new BatteryGauge();

  constructor(entry: TopicEntry) {
    this.#entry = entry;
    this.#board = entry.as === 'diagnostics' ? new DiagnosticBoard() : null;
    this.#limit = new RateLimit(entry.most);
  }

  static is({ as }: TopicEntry): boolean {
    return READING_ROLES.includes(as);
  }

  /**
   * Diagnostics come from many nodes, each with its part. All are read, and merged into readings at the permitted
   * rate.
   */
  get readsAll(): boolean {
    return this.#board !== null;
  }

  /** @returns whether to read the message that arrives now */
  admits(nowMs: number): boolean {
    return this.readsAll || this.#limit.admits(nowMs);
  }

  /**
   * Takes an admitted message. @returns `null` if it is too early for the next reading @throws {Error} if the message
   * is invalid
   */
  take(message: unknown, nowMs: number): TopicReading | null {
    const entry = this.#entry;
    if (this.#board === null) {
      const numbers = numbersOf(entry, message, this.#gauge);
      return { ...readingOf(entry, message, this.#gauge), ...(numbers.length === 0 ? {} : { numbers }) };
    }
    const told = this.#board.take(message, nowMs);
    if (!this.#limit.admits(nowMs)) return null;
    return { ...readingOf(entry, told), components: this.#board.components };
  }
}
