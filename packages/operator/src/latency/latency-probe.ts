/** Runs latency tests: requests the lease, sends the flagged command, gives up if no frame comes. */
import { type LatencyFrame, pointsOfBytes } from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import type { Driver } from '../drive/driver.ts';
import type { RobotLink } from '../link/robot-link.ts';
import { type LatencyFailure, type LatencyResult, LatencyTest } from './latency-test.ts';

/** The result of a latency test, with the robot's measurements. */
export type LatencyReport = LatencyResult & {
  /** What the robot reported of the answering frame; `null` if its message was lost. */
  robot: LatencyFrame | null;
};

/** Thrown if a latency test has no result. */
export class LatencyError extends Error {
  /** Identifies the class where `instanceof` cannot. */
  override readonly name = 'LatencyError';
  /** Why there is no result. */
  readonly reason: LatencyFailure;

  constructor(reason: LatencyFailure) {
    super(`latency test: ${reason}`);
    this.reason = reason;
  }
}

interface Waiting {
  resolve: (report: LatencyReport) => void;
  reject: (error: LatencyError) => void;
  deadlineMs: number;
  repeatMs: number;
  /** Not sent yet: the lease has been requested. */
  needsLease: boolean;
  robot: LatencyFrame | null;
}

/**
 * Without an answer after this time, a test has failed, ms. Chosen: above the loop of any link that can be
 * driven by.
 */
const TIMEOUT_MS = 3000;
/**
 * A request that the robot has not confirmed is repeated at this interval, because commands may be lost.
 * Chosen: two commands' intervals.
 */
const REPEAT_MS = 50;

/** Runs latency tests. {@link RobotClient} creates and calls it; an app calls {@link RobotClient.latencyTest}. */
export class LatencyProbe {
  readonly #link: RobotLink;
  readonly #driver: Driver;
  readonly #onResult: (result: LatencyResult) => void;
  readonly #test = new LatencyTest();
  #waiting: Waiting | null = null;

  /**
   * @param link to the robot
   * @param driver holds the lease that a test needs
   * @param onResult told of each result
   */
  constructor(link: RobotLink, driver: Driver, onResult: (result: LatencyResult) => void) {
    this.#link = link;
    this.#driver = driver;
    this.#onResult = onResult;
  }

  /**
   * Runs a test. Only one can run at a time.
   *
   * @param startedAtMs when the operator acted. If the lease must be requested first, time runs from its grant.
   * @throws {LatencyError} if there is no session, another test runs, somebody else drives, or no frame came within 3 s
   */
  run(startedAtMs: number): Promise<LatencyReport> {
    if (this.#waiting !== null) return Promise.reject(new LatencyError('busy'));
    if (this.#link.phase !== 'live') return Promise.reject(new LatencyError('no-session'));
    return new Promise((resolve, reject) => {
      const needsLease = this.#driver.stream.lease === null;
      this.#waiting = {
        resolve,
        reject,
        deadlineMs: startedAtMs + TIMEOUT_MS,
        repeatMs: Number.POSITIVE_INFINITY,
        needsLease,
        robot: null,
      };
      if (needsLease) this.#driver.requestLease(false);
      else this.#send(startedAtMs);
    });
  }

  /** The robot sent the state of the lease: a test that waits for it begins or fails. */
  onLease(): void {
    if (this.#waiting?.needsLease !== true) return;
    if (this.#driver.stream.lease !== null) this.#send(performance.now());
    else if (this.#driver.holder === 'other') this.fail('no-lease');
  }

  /** The robot said which frame answers a test. */
  onRobotFrame(frame: LatencyFrame): void {
    if (this.#waiting !== null && frame.id === this.#test.runningId) this.#waiting.robot = frame;
  }

  /**
   * A packet's points were uploaded for the display frame being prepared.
   *
   * @param packet index in the batch
   */
  onPacket(batch: Batch, packet: number): void {
    this.#test.onPacket(
      batch.isLatencyTest(packet),
      batch.frameNumber(packet),
      batch.pointsCame(packet),
      pointsOfBytes(batch.frameLength(packet)),
      batch.receivedAtMs(packet) - performance.timeOrigin,
    );
  }

  /** Whether the display frame being drawn must be timed. */
  get wantsTime(): boolean {
    return this.#test.wantsTime;
  }

  /**
   * The display frame with the points reported by {@link onPacket} is finished.
   *
   * @param nowMs `performance.now()`
   */
  onDrawn(nowMs: number): void {
    const result = this.#test.onDrawn(nowMs);
    if (result === null) return;
    const waiting = this.#waiting;
    this.#waiting = null;
    this.#onResult(result);
    console.info(`motion to photon ${result.mtpMs.toFixed(1)} ms (first ${result.firstMs.toFixed(1)} ms)`);
    waiting?.resolve({ ...result, robot: waiting.robot });
  }

  /**
   * Repeats an unanswered request, and gives up after the time limit. Call it several times a second.
   *
   * @param nowMs `performance.now()`
   */
  sendDue(nowMs: number): void {
    const waiting = this.#waiting;
    if (waiting === null) return;
    if (nowMs >= waiting.deadlineMs) this.fail('timeout');
    else if (nowMs >= waiting.repeatMs && waiting.robot === null) this.#request(nowMs);
  }

  /** Ends the running test, if there is one, without a result. */
  fail(reason: LatencyFailure): void {
    const waiting = this.#waiting;
    this.#waiting = null;
    this.#test.cancel();
    waiting?.reject(new LatencyError(reason));
  }

  #send(startedAtMs: number): void {
    const waiting = this.#waiting!;
    waiting.needsLease = false;
    waiting.deadlineMs = startedAtMs + TIMEOUT_MS;
    this.#test.start(startedAtMs);
    this.#request(performance.now());
  }

  #request(nowMs: number): void {
    const { runningId } = this.#test;
    const command = runningId === null ? null : this.#driver.stream.latencyTest(nowMs, runningId);
    if (command === null) {
      this.fail('no-lease');
      return;
    }
    this.#waiting!.repeatMs = nowMs + REPEAT_MS;
    this.#link.sendCommand(command);
  }
}
