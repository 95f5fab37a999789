/**
 * Motion-to-photon latency as the paper measures it: an input event requests a green cloud, and the time runs until the
 * end of the display frame that shows it. There are two results: for the first green points, and for the whole green
 * cloud (all its packets, or those that came before the next frame began). No clock and no GPU here.
 */
import { nextSequence32, sequenceDelta32 } from '@farpoint/protocol';

/** What a latency test measured. Times run from the input event. */
export interface LatencyResult {
  /** Number of the test. */
  id: number;
  /** The input event, by the operator's clock, ms. */
  startedAtMs: number;
  /** Input event to the end of the display frame with the whole green cloud, ms. */
  mtpMs: number;
  /** Input event to the end of the display frame with the first green points, ms. */
  firstMs: number;
  /** Input event to the arrival of the last green packet, ms. */
  arrivedMs: number;
  /** Green points drawn. */
  points: number;
  /** Green points in the whole frame. */
  totalPoints: number;
  /** The green frame. */
  frameNumber: number;
}

/** Why a test has no result. */
export type LatencyFailure =
  /** The command, or every packet of its frame, was lost. */
  | 'timeout'
  | 'no-session'
  /** Another test is running. */
  | 'busy'
  /** Somebody else drives. */
  | 'no-lease';

interface Running {
  id: number;
  startedAtMs: number;
  frameNumber: number | null;
  points: number;
  totalPoints: number;
  firstMs: number | null;
  arrivedMs: number;
  /** Uploaded for the display frame that is being drawn. */
  fresh: boolean;
  /** No more of the frame will come. */
  complete: boolean;
}

export class LatencyTest {
  #running: Running | null = null;
  #lastId = 0;

  get runningId(): number | null {
    return this.#running?.id ?? null;
  }

  /** @param startedAtMs the input event's time. @returns the id that the command must carry */
  start(startedAtMs: number): number {
    this.#lastId = nextSequence32(this.#lastId);
    this.#running = {
      id: this.#lastId,
      startedAtMs,
      frameNumber: null,
      points: 0,
      totalPoints: 0,
      firstMs: null,
      arrivedMs: 0,
      fresh: false,
      complete: false,
    };
    return this.#lastId;
  }

  /** Ends the test without a result. */
  cancel(): void {
    this.#running = null;
  }

  /** A packet's points, which arrived at `receivedAtMs`, were uploaded for the display frame being prepared. */
  onPacket(
    isLatencyTest: boolean,
    frameNumber: number,
    points: number,
    totalPoints: number,
    receivedAtMs: number,
  ): void {
    const test = this.#running;
    if (test === null || test.complete) return;
    if (!isLatencyTest) {
      // The next frame has begun: whatever is missing of the green one was lost.
      if (test.frameNumber !== null && sequenceDelta32(frameNumber, test.frameNumber) > 0)
        test.complete = true;
      return;
    }
    if (test.frameNumber === null) {
      test.frameNumber = frameNumber;
      test.totalPoints = totalPoints;
    }
    if (frameNumber !== test.frameNumber) return;
    test.points += points;
    test.arrivedMs = Math.max(test.arrivedMs, receivedAtMs - test.startedAtMs);
    test.fresh = true;
    if (test.points >= totalPoints) test.complete = true;
  }

  /** Whether the display frame being drawn must be timed: it shows new green points, or ends the test. */
  get wantsTime(): boolean {
    const test = this.#running;
    return test !== null && test.frameNumber !== null && (test.fresh || test.complete);
  }

  /**
   * The GPU has finished the display frame with the points reported by {@link onPacket}.
   *
   * @returns the result if the test is over
   */
  onDrawn(nowMs: number): LatencyResult | null {
    const test = this.#running;
    if (test === null || test.frameNumber === null) return null;
    if (test.fresh) {
      test.firstMs ??= nowMs - test.startedAtMs;
      this.#lastFreshMs = nowMs;
    }
    const hadFresh = test.fresh;
    test.fresh = false;
    if (!test.complete || test.firstMs === null) return null;
    this.#running = null;
    // The start of the next frame ended the test: an earlier display frame showed the last green points.
    const endMs = hadFresh ? nowMs : this.#lastFreshMs;
    return {
      id: test.id,
      startedAtMs: test.startedAtMs,
      mtpMs: endMs - test.startedAtMs,
      firstMs: test.firstMs,
      arrivedMs: test.arrivedMs,
      points: test.points,
      totalPoints: test.totalPoints,
      frameNumber: test.frameNumber,
    };
  }

  #lastFreshMs = 0;
}
