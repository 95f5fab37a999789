/** The two ends of the link of `pnpm bench prediction`: the robot, and the page that predicts it. */
import { MotionPredictor, ReconciledPose } from '@farpoint/operator/prediction';
import { ClockOffset, zeroTwist } from '@farpoint/protocol';
import { VelocityRamp } from '@farpoint/safety';
import { type BaseKind, type DrivenBase, newBase } from './prediction-bases.ts';
import type { Command, Down, Pose, Wish } from './prediction-link.ts';

export const FRAME_MS = 1000 / 60;
const WHEELS_MS = 10;
const WATCHDOG_MS = 150;
/** The robot's ramps; its base may be slower. */
const RAMPS = { accelerationMps2: 1, decelerationMps2: 2, turnRadps2: 3 };
const LIMITS = { maxLinear: 1, maxAngular: 1.5, watchdogMs: WATCHDOG_MS, ...RAMPS };
/** Time constant with which the page follows poses without prediction, ms. */
const FOLLOW_MS = 90;
/** A view that has moved by this much has moved, m or rad. */
const MOVED = 2e-5;

/** Makes its base follow the newest command, until none arrives any more. */
export class RobotEnd {
  readonly #base: DrivenBase;
  readonly #ramp = new VelocityRamp(
    { ...RAMPS, emergencyMps2: 4, emergencyTurnRadps2: 2 * RAMPS.turnRadps2 },
    WATCHDOG_MS,
  );
  readonly #wanted = zeroTwist();
  #wish: Wish = [0, 0];
  #sequence = 0;
  #heardMs = Number.NEGATIVE_INFINITY;

  constructor(kind: BaseKind) {
    this.#base = newBase(kind);
  }

  /** A copy of the base's pose. */
  get pose(): Pose {
    return { ...this.#base.pose };
  }

  /** Ignores a command that a newer one has overtaken. */
  accept({ sequence, wish }: Command, atMs: number): void {
    if (sequence <= this.#sequence) return;
    this.#sequence = sequence;
    this.#wish = wish;
    this.#heardMs = atMs;
  }

  /** Moves the base by a millisecond. */
  step(nowMs: number): void {
    if (nowMs % WHEELS_MS === 0) {
      const [linear, angular] = nowMs - this.#heardMs < WATCHDOG_MS ? this.#wish : [0, 0];
      this.#wanted.linear.x = linear;
      this.#wanted.angular.z = angular;
      const ramped = this.#ramp.step(this.#wanted, false, nowMs);
      this.#base.command(ramped.linear.x, ramped.angular.z);
    }
    this.#base.step(0.001);
  }
}

/** Where a drawn frame shows the robot. */
export interface Picture {
  shownMs: number;
  /** With prediction. */
  view: Pose;
  /** The newest pose, followed as the page does without prediction. */
  plain: Pose;
  /** The newest pose as it came. */
  newest: Pose;
}

export class PageEnd {
  readonly predictor = new MotionPredictor();
  /** The most that one frame corrected, m and rad. */
  correctionM = 0;
  correctionRad = 0;
  /** From a key to the drawing of the first frame in which the view has moved, from standing. */
  readonly inputToViewMs: number[] = [];
  readonly #clock = new ClockOffset();
  readonly #view = new ReconciledPose();
  readonly #plain: Pose = { x: 0, y: 0, yaw: 0 };
  #newest: Pose = this.#plain;
  #newestMs = 0;
  #wish: Wish = [0, 0];
  #pressedMs: number | null = null;
  /** Pictures that are drawn and not shown yet. */
  readonly #waiting: Picture[] = [];

  constructor() {
    this.predictor.setLimits(LIMITS);
    this.predictor.driving = true;
  }

  accept(message: Down, atMs: number): void {
    if (message.kind === 'answer') {
      this.#clock.add({ type: 'clockAnswer', ...message }, atMs);
      this.predictor.setClock(this.#clock.offsetMs, this.#clock.minRttMs);
    } else if (message.kind === 'cloud') {
      if (message.robotMs > this.#newestMs) this.#newest = message.pose;
      this.#newestMs = Math.max(this.#newestMs, message.robotMs);
    } else
      this.predictor.onReport({
        robotMs: message.robotMs,
        arrivedMs: atMs,
        ...message.pose,
        held: false,
        factor: 1,
        mostLinear: LIMITS.maxLinear,
      });
  }

  /** Takes what the hand holds now. */
  hold(wish: Wish, nowMs: number): void {
    const stood = this.#wish[0] === 0 && this.#wish[1] === 0;
    if (stood && (wish[0] !== 0 || wish[1] !== 0)) this.#pressedMs = nowMs;
    this.#wish = wish;
  }

  /** Draws a frame, which is shown when the next one is drawn. */
  draw(nowMs: number): void {
    const shownMs = nowMs + FRAME_MS;
    const [linear, angular] = this.#wish;
    this.predictor.wish(nowMs, linear, angular);
    const view = this.#view;
    const before = { x: view.x, y: view.y, yaw: view.yaw };
    view.follow(this.predictor, shownMs);
    this.correctionM = Math.max(this.correctionM, view.correctedM);
    this.correctionRad = Math.max(this.correctionRad, view.correctedRad);
    const moved = Math.hypot(view.x - before.x, view.y - before.y) + Math.abs(view.yaw - before.yaw);
    if (this.#pressedMs !== null && moved > MOVED) {
      this.inputToViewMs.push(nowMs - this.#pressedMs);
      this.#pressedMs = null;
    }
    this.#follow();
    const shown = { x: view.x, y: view.y, yaw: view.yaw };
    this.#waiting.push({ shownMs, view: shown, plain: { ...this.#plain }, newest: this.#newest });
  }

  /** Takes the next picture that is shown by now; `null` if none is left. */
  takeShown(nowMs: number): Picture | null {
    const next = this.#waiting[0];
    if (next === undefined || next.shownMs > nowMs) return null;
    this.#waiting.shift();
    return next;
  }

  /** Moves the view without prediction towards the newest pose, for a frame. */
  #follow(): void {
    const [plain, newest] = [this.#plain, this.#newest];
    const share = 1 - Math.exp(-FRAME_MS / FOLLOW_MS);
    plain.x += (newest.x - plain.x) * share;
    plain.y += (newest.y - plain.y) * share;
    const turn = newest.yaw - plain.yaw;
    plain.yaw += (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))) * share;
  }
}
