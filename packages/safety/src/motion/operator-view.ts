import { RecentWorst } from '@farpoint/timing';

/**
 * A stamp may be this far ahead of the robot's clock: it is rounded on its way. Chosen: a whole millisecond
 * at either end.
 */
export const ROUNDING_MS = 2;
/**
 * From one picture to the next, before that is known, ms. The robot plans no fewer than ten clouds a second.
 */
const FIRST_INTERVAL_MS = 100;

/**
 * How old what the driver sees is: from the robot's capture, over the link, to the operator's eye and back with a
 * command. All on the robot's clock, so no clocks need to be in step.
 *
 * Only commands tell. While none comes, nothing is known, and nobody drives by it: the first command after a pause starts
 * anew, with the age of what it names. A page that hangs and still sends commands names an old picture.
 */
export class OperatorView {
  /** When the newest picture that the driver has seen was captured, ms; `null` while nothing is known. */
  #capturedMs: number | null = null;
  /** When a command first named it. */
  #namedMs = 0;
  /** Of the latest command. */
  #heardMs = Number.NEGATIVE_INFINITY;
  /** Whether the newest picture is the one that a pause ended with: how long it has been shown says nothing about others. */
  #isFirst = false;
  readonly #pauseMs: number;
  readonly #ages = new RecentWorst();
  readonly #intervals = new RecentWorst();
  /** When something was last sent for the driver to see; `null` if that is not known. */
  #sentMs: number | null = null;
  readonly #sendIntervals = new RecentWorst();

  /** @param pauseMs commands further apart than this have a pause between them */
  constructor(pauseMs: number) {
    this.#pauseMs = pauseMs;
  }

  /**
   * A command says what the driver sees. An older picture than one that was named before changes nothing.
   *
   * @param ageMs since the capture of the newest picture that is drawn, when the command came. A negative age is
   * refused: no picture comes from the future
   */
  note(ageMs: number | null, nowMs: number): void {
    if (this.#isPaused(nowMs)) this.#capturedMs = null;
    this.#heardMs = nowMs;
    if (ageMs === null || !(ageMs >= -ROUNDING_MS)) return;
    const capturedMs = nowMs - ageMs;
    if (this.#capturedMs === null) {
      this.#isFirst = true;
      this.#ages.reset(nowMs);
      this.#intervals.reset(nowMs);
      this.#intervals.add(FIRST_INTERVAL_MS, nowMs);
    } else {
      if (capturedMs <= this.#capturedMs) return;
      if (!this.#isFirst) this.#ages.add(nowMs - this.#capturedMs, nowMs);
      this.#isFirst = false;
      this.#intervals.add(nowMs - this.#namedMs, nowMs);
    }
    this.#capturedMs = capturedMs;
    this.#namedMs = nowMs;
  }

  /** A picture or cloud was sent to the driver, whether or not it will arrive. */
  sent(nowMs: number): void {
    if (this.#sentMs === null) this.#sendIntervals.reset(nowMs);
    this.#sendIntervals.add(this.#sentMs === null ? FIRST_INTERVAL_MS : nowMs - this.#sentMs, nowMs);
    this.#sentMs = nowMs;
  }

  /** Somebody else drives, or nobody. */
  forget(): void {
    this.#capturedMs = null;
    this.#sentMs = null;
  }

  /** Age of what the driver sees, ms; `null` while it is not known. */
  ageMs(nowMs: number): number | null {
    return this.#capturedMs === null || this.#isPaused(nowMs) ? null : nowMs - this.#capturedMs;
  }

  /** The greatest age within the last second or so, ms; `null` while it is not known. */
  worstAgeMs(nowMs: number): number | null {
    const ageMs = this.ageMs(nowMs);
    return ageMs === null ? null : Math.max(this.#ages.at(nowMs), ageMs);
  }

  /**
   * How much longer than usual nothing newer has been seen, or sent, ms; negative while the next picture is not due. What
   * was not even sent will not be seen: on a slow link, a dead camera is noticed before the driver can.
   */
  overdueMs(nowMs: number): number {
    const unseenMs = nowMs - this.#namedMs - this.#intervals.at(nowMs);
    if (this.#sentMs === null) return unseenMs;
    return Math.max(unseenMs, nowMs - this.#sentMs - this.#sendIntervals.at(nowMs));
  }

  #isPaused(nowMs: number): boolean {
    return !(nowMs - this.#heardMs <= this.#pauseMs);
  }
}
