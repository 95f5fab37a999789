/** Runs latency tests: asks for the lease, sends the flagged command, gives up when nothing comes. */
import type { LatencyFrame } from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import type { Driver } from '../drive/driver.ts';
import type { RobotLink } from '../link/robot-link.ts';
import { type LatencyFailure, type LatencyResult, LatencyTest } from './latency-test.ts';

export type LatencyReport = LatencyResult & { robot: LatencyFrame | null };

/** Thrown to whoever asked for a test without a result. */
export class LatencyError extends Error {
  override readonly name = 'LatencyError';
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
  /** Not sent yet: the lease is being asked for. */
  needsLease: boolean;
  robot: LatencyFrame | null;
}

const TIMEOUT_MS = 3000;
/** A request that the robot has not confirmed is sent again after so long, as every command is: messages get lost. */
const REPEAT_MS = 50;

export class LatencyProbe {
  readonly #link: RobotLink;
  readonly #driver: Driver;
  readonly #onResult: (result: LatencyResult) => void;
  readonly #test = new LatencyTest();
  #waiting: Waiting | null = null;

  constructor(link: RobotLink, driver: Driver, onResult: (result: LatencyResult) => void) {
    this.#link = link;
    this.#driver = driver;
    this.#onResult = onResult;
  }

  /**
   * One test at a time.
   *
   * @param startedAtMs when the operator acted. Where the lease must be asked for first, the time runs from its coming.
   * @throws {LatencyError}
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

  onLease(): void {
    if (this.#waiting?.needsLease !== true) return;
    if (this.#driver.stream.lease !== null) this.#send(performance.now());
    else if (this.#driver.holder === 'other') this.fail('no-lease');
  }

  onRobotFrame(frame: LatencyFrame): void {
    if (this.#waiting !== null && frame.id === this.#test.runningId) this.#waiting.robot = frame;
  }

  onPacket(batch: Batch, packet: number): void {
    this.#test.onPacket(
      batch.isLatencyTest(packet),
      batch.frameNumber(packet),
      batch.pointsCame(packet),
      batch.frameLength(packet) / 8,
      batch.receivedAtMs(packet) - performance.timeOrigin,
    );
  }

  get wantsTime(): boolean {
    return this.#test.wantsTime;
  }

  onDrawn(nowMs: number): void {
    const result = this.#test.onDrawn(nowMs);
    if (result === null) return;
    const waiting = this.#waiting;
    this.#waiting = null;
    this.#onResult(result);
    console.info(`motion to photon ${result.mtpMs.toFixed(1)} ms (first ${result.firstMs.toFixed(1)} ms)`);
    waiting?.resolve({ ...result, robot: waiting.robot });
  }

  tick(nowMs: number): void {
    const waiting = this.#waiting;
    if (waiting === null) return;
    if (nowMs >= waiting.deadlineMs) this.fail('timeout');
    else if (nowMs >= waiting.repeatMs && waiting.robot === null) this.#request(nowMs);
  }

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
