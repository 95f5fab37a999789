import { RecentWorst } from './recent-worst.ts';
import { UsualInterval } from './usual-interval.ts';

/** A stamp may be this far ahead of the robot's clock: it is rounded on its way. */
const ROUNDING_MS = 2;
/** From one picture to the next, before that is known, ms. */
const FIRST_INTERVAL_MS = 100;

/**
 * How old what the driver sees is: from the robot's capture, over the link, to the operator's eye and back with a
 * command. All on the robot's clock, so no clocks need to be in step.
 */
export class OperatorView {
  /** When the newest picture that the driver has seen was captured, ms; `null` while nothing is known. */
  #capturedMs: number | null = null;
  /** When a command first named it. */
  #namedMs = 0;
  /** When a command last came, whatever it named. */
  #heardMs = Number.NEGATIVE_INFINITY;
  readonly #ages = new RecentWorst();
  readonly #intervals = new RecentWorst();
  /** When something was last taken for the driver to see; `null` if that is not known. */
  #suppliedMs: number | null = null;
  readonly #supplyIntervals = new UsualInterval();

  /**
   * A command says what the driver sees. An older picture than one that was named before changes nothing.
   *
   * @param ageMs since the capture of the newest picture that is drawn, when the command came. A picture from the future
   * is none
   */
  note(ageMs: number | null, nowMs: number): void {
    this.#heardMs = nowMs;
    if (ageMs === null || !(ageMs >= -ROUNDING_MS)) return;
    const capturedMs = nowMs - ageMs;
    if (this.#capturedMs === null) {
      this.#ages.reset(nowMs);
      this.#ages.add(ageMs, nowMs);
      this.#intervals.reset(nowMs);
      this.#intervals.add(FIRST_INTERVAL_MS, nowMs);
    } else {
      if (capturedMs <= this.#capturedMs) return;
      this.#ages.add(nowMs - this.#capturedMs, nowMs);
      this.#intervals.add(nowMs - this.#namedMs, nowMs);
    }
    this.#capturedMs = capturedMs;
    this.#namedMs = nowMs;
  }

  /**
   * A picture or cloud was taken that will be sent to the driver, whether or not it will arrive. When it is sent would
   * say less about the camera: on a slow link, it waits.
   */
  supplied(nowMs: number): void {
    if (this.#suppliedMs === null) this.#supplyIntervals.reset(nowMs);
    this.#supplyIntervals.add(
      this.#suppliedMs === null ? FIRST_INTERVAL_MS : nowMs - this.#suppliedMs,
      nowMs,
    );
    this.#suppliedMs = nowMs;
  }

  /** Somebody else drives, or nobody. */
  forget(): void {
    this.#capturedMs = null;
    this.#suppliedMs = null;
  }

  /** Age of what the driver sees, ms; `null` while it is not known. */
  ageMs(nowMs: number): number | null {
    return this.#capturedMs === null ? null : nowMs - this.#capturedMs;
  }

  /** The greatest age within the last second or so, ms; `null` while it is not known. */
  worstAgeMs(nowMs: number): number | null {
    return this.#capturedMs === null ? null : Math.max(this.#ages.at(nowMs), nowMs - this.#capturedMs);
  }

  /** For how long no command has said what the driver sees, ms: a hand that is open says nothing. */
  silentMs(nowMs: number): number {
    return nowMs - this.#heardMs;
  }

  /** How much longer than usual the driver has seen nothing newer, ms; negative while the next picture is not due. */
  unseenMs(nowMs: number): number {
    return nowMs - this.#namedMs - this.#intervals.at(nowMs);
  }

  /**
   * How much longer than usual nothing was taken, ms; negative while the next picture is not due, or if nothing is known.
   * What was not even taken will not be seen: on a slow link, a dead camera is noticed before the driver can.
   */
  unsuppliedMs(nowMs: number): number {
    if (this.#suppliedMs === null) return Number.NEGATIVE_INFINITY;
    return nowMs - this.#suppliedMs - this.#supplyIntervals.at(nowMs);
  }
}
