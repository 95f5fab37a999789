/**
 * Where the robot is when the picture is shown: the newest reported pose, led on by the commands that the robot had heard by
 * then and has not answered for yet. The base's model is identified meanwhile. Pure: times are arguments. The operator's
 * clock and the robot's need not be synchronised.
 */
import { shortestTurn } from '@farpoint/protocol';
import { WindowedMinimum } from '@farpoint/timing';
import {
  type BaseModel,
  type BaseMotion,
  coast,
  copyMotion,
  STEP_MS,
  standingAt,
  stepBase,
  usualBase,
} from './base-model.ts';
import { CommandHistory } from './command-history.ts';
import { ModelFit } from './model-fit.ts';
import type { PredictionLimits, PredictionState, ReportedMotion } from './reported-motion.ts';
import { TravelWindow } from './travel-window.ts';

// `pnpm bench prediction` measures what these numbers give together (docs/prediction.md).

/** With no report for so long, or none that young, the robot is shown where it was last seen, ms. */
const STALE_MS = 700;
/**
 * How far the view may lead the robot, m and rad: enough to move in the very frame, too little to matter as
 * an error.
 */
const LEAD_M = 0.015;
const LEAD_RAD = 0.0105;
/** A pose beyond what the robot can have driven, by this much, is a jump to another place: m and rad. */
const JUMP_M = 0.5;
const JUMP_RAD = 1;
/** Share of what the model missed that corrects the velocity. */
const TRUST = 0.5;
/** What the robot does within this time of a change of the commands tells of its model, ms. */
const EXCITED_MS = 2000;
/** Reports further apart say too little of the velocity between them, ms. */
const GAP_MS = 400;
/** The fastest report of this time relates the two clocks, ms: they differ by up to 100 ppm, 3 ms in 30 s. */
const FASTEST_WINDOW_MS = 30_000;
/** From a command's arrival to the wheels, and from a pose to its telemetry: a guess until it is identified, ms. */
const USUAL_HANDLING_MS = 30;
/** Of a loop without clock answers, ms. */
const USUAL_LOOP_MS = 100;

export class MotionPredictor {
  /** Whether this operator's commands move the robot: it holds the lease. */
  driving = false;
  /** Whether an emergency stop is latched, or is on its way: from then on only reports count. */
  stopped = false;
  /** Whether the path is lost. */
  silent = false;
  /** Poses that were jumps to another place. */
  jumps = 0;
  readonly #window = new TravelWindow();
  readonly #commands = new CommandHistory(() => this.#limits.watchdogMs);
  #limits: PredictionLimits = { maxLinear: 0, maxAngular: 0, watchdogMs: 150 };
  #fit = this.#newFit();
  readonly #fastest = new WindowedMinimum(FASTEST_WINDOW_MS);
  #fastestMs = 0;
  #clockOffsetMs: number | null = null;
  #has = false;
  /** The newest report, with an estimate of the velocity. */
  readonly #anchor: BaseMotion = standingAt();
  #robotMs = 0;
  #arrivedMs = 0;
  #held = false;
  #factor = 1;
  #mostLinear = 0;
  readonly #roll: BaseMotion = standingAt();
  readonly #commanded: BaseMotion = standingAt();

  /** The model as it is identified so far. */
  get model(): Readonly<BaseModel> {
    return this.#fit.model;
  }

  /** Another robot, or another session: nothing is known of it. */
  reset(): void {
    this.#commands.clear();
    this.#window.clear();
    this.#fit = this.#newFit();
    this.#fastest.reset();
    this.#clockOffsetMs = null;
    this.#has = false;
    this.jumps++;
  }

  /** The robot's welcome. */
  setLimits(limits: Readonly<PredictionLimits>): void {
    this.#limits = { ...limits };
    this.#mostLinear = limits.maxLinear;
    if (!this.#fit.excited) this.#fit = this.#newFit();
  }

  /** A command leaves. @param linear m/s @param angular rad/s @param lateral m/s, to the left */
  onCommand(nowMs: number, linear: number, angular: number, lateral = 0): void {
    this.#commands.add(nowMs, linear, angular, lateral);
  }

  /** What the hand wants now, for each display frame: the command with it leaves within a few milliseconds. */
  wish(nowMs: number, linear: number, angular: number, lateral = 0): void {
    this.#commands.expire(nowMs);
    this.#commands.wish(nowMs, linear, angular, lateral);
  }

  /** In place of {@link wish} while the hand drives nothing. */
  noWish(nowMs: number): void {
    this.#commands.expire(nowMs);
    this.#commands.noWish();
  }

  /**
   * @param offsetMs robot's clock minus operator's, from probes that assume the same delay both ways; `null`: not known
   * @param rttMs shortest round trip
   */
  setClock(offsetMs: number | null, rttMs: number | null): void {
    this.#clockOffsetMs = offsetMs;
    if (!this.#fit.excited && rttMs !== null) this.#fit.model.delayMs = rttMs + USUAL_HANDLING_MS;
  }

  onReport(report: Readonly<ReportedMotion>): void {
    const { robotMs, arrivedMs, x, y } = report;
    this.#arrivedMs = arrivedMs;
    const wasFree = !this.#held && this.#factor === 1;
    this.#held = report.held;
    this.#factor = Math.min(Math.max(report.factor, 0), 1);
    this.#mostLinear = Math.min(report.mostLinear, this.#limits.maxLinear);
    const anchor = this.#anchor;
    if (this.#has && robotMs <= this.#robotMs) return;
    this.#fastest.add(arrivedMs - robotMs, arrivedMs);
    this.#fastestMs = this.#fastest.value;
    const yaw = anchor.yaw + shortestTurn(report.yaw - anchor.yaw);
    const sinceMs = robotMs - this.#robotMs;
    const isJump = this.#has && this.#jumps(x - anchor.x, y - anchor.y, yaw - anchor.yaw, sinceMs / 1000);
    if (isJump || !this.#has) this.jumps++;
    if (!this.#has || isJump || sinceMs > GAP_MS) {
      anchor.linear = 0;
      anchor.lateral = 0;
      anchor.angular = 0;
    } else this.#learn(x, y, yaw, robotMs, wasFree && !this.#held && this.#factor === 1);
    this.#has = true;
    anchor.x = x;
    anchor.y = y;
    anchor.yaw = yaw;
    this.#robotMs = robotMs;
  }

  /** Why the pose is led on, or not. @param atMs operator's clock */
  stateAt(atMs: number): PredictionState {
    if (!this.#has) return 'no-pose';
    if (!this.driving) return 'not-driving';
    if (this.#held || this.stopped) return 'held';
    const isStale =
      this.silent || atMs - this.#arrivedMs > STALE_MS || this.#robotAt(atMs) - this.#robotMs > STALE_MS;
    return isStale ? 'stale' : 'predicted';
  }

  /** How much later than the newest report the pose is that {@link poseAt} gives, ms. */
  aheadMs(atMs: number): number {
    return this.stateAt(atMs) === 'predicted' ? Math.max(0, this.#robotAt(atMs) - this.#robotMs) : 0;
  }

  /**
   * The robot when the picture is shown, and a little of where the commands lead it that are still on their way, so that
   * the view answers the hand at once. As reported where nothing may be predicted.
   *
   * @param atMs when the picture is shown: operator's clock, ms
   * @param into gets the pose and the velocity
   */
  poseAt(atMs: number, into: BaseMotion): void {
    copyMotion(this.#anchor, into);
    if (this.stateAt(atMs) !== 'predicted') return;
    const robotMs = this.#robotAt(atMs);
    if (robotMs < this.#robotMs) this.#comeBack(into, (this.#robotMs - robotMs) / 1000);
    else this.#lead(into, this.#robotMs, robotMs);
    const commanded = this.#commanded;
    copyMotion(into, commanded);
    this.#lead(commanded, robotMs, atMs + this.#shiftMs);
    const dx = commanded.x - into.x;
    const dy = commanded.y - into.y;
    const turn = commanded.yaw - into.yaw;
    const share = softly(Math.hypot(dx, dy), LEAD_M);
    into.x += dx * share;
    into.y += dy * share;
    into.yaw += turn * softly(Math.abs(turn), LEAD_RAD);
  }

  #comeBack(motion: BaseMotion, seconds: number): void {
    coast(motion, motion.linear, motion.angular, -seconds, motion.lateral);
  }

  /** Operator's clock when a command leaves → robot's clock when the wheels hear of it. */
  get #shiftMs(): number {
    return this.#fit.model.delayMs - this.#fastestMs;
  }

  /** The robot's clock at this instant. Without clock answers, both ways are taken for equally long. */
  #robotAt(atMs: number): number {
    const heardMs = atMs + this.#shiftMs;
    const robotMs =
      this.#clockOffsetMs === null ? heardMs - this.#fit.model.delayMs / 2 : atMs + this.#clockOffsetMs;
    // It is not younger than what commands of now will do, nor older than what could be seen now.
    return Math.min(Math.max(robotMs, atMs - this.#fastestMs), heardMs);
  }

  /** Lets the base follow its commands. @param fromMs and toMs: robot's clock */
  #lead(motion: BaseMotion, fromMs: number, toMs: number): void {
    const commands = this.#commands;
    const { model } = this.#fit;
    const shiftMs = this.#shiftMs;
    const wishMs = commands.wishMs + shiftMs;
    let index = commands.indexAt(fromMs - shiftMs);
    let nowMs = fromMs;
    while (nowMs < toMs) {
      const edgeMs =
        index + 1 < commands.length ? commands.timeMs(index + 1) + shiftMs : Number.POSITIVE_INFINITY;
      if (edgeMs <= nowMs) {
        index++;
        continue;
      }
      const wishes = nowMs >= wishMs;
      const endMs = Math.min(toMs, edgeMs, wishes ? Number.POSITIVE_INFINITY : wishMs, nowMs + STEP_MS);
      const linear = model.linear.gain * (wishes ? commands.wishLinear : commands.linear(index));
      const angular = model.angular.gain * (wishes ? commands.wishAngular : commands.angular(index));
      const lateral = model.linear.gain * (wishes ? commands.wishLateral : commands.lateral(index));
      const { maxAngular } = this.#limits;
      stepBase(
        motion,
        model,
        within(linear * this.#factor, this.#mostLinear),
        within(angular * this.#factor, maxAngular),
        (endMs - nowMs) / 1000,
        within(lateral * this.#factor, this.#mostLateral),
      );
      nowMs = endMs;
    }
  }

  /** What bounds the robot forwards bounds it sideways. */
  get #mostLateral(): number {
    const { maxLinear, maxLateral = 0 } = this.#limits;
    return this.#mostLinear < maxLinear ? Math.min(this.#mostLinear, maxLateral) : maxLateral;
  }

  /** What a report tells of the velocity, and of the model. @param free the robot followed its commands all the while */
  #learn(x: number, y: number, yaw: number, robotMs: number, free: boolean): void {
    const anchor = this.#anchor;
    const seconds = (robotMs - this.#robotMs) / 1000;
    const heading = (anchor.yaw + yaw) / 2;
    const travel = (x - anchor.x) * Math.cos(heading) + (y - anchor.y) * Math.sin(heading);
    const aside = (y - anchor.y) * Math.cos(heading) - (x - anchor.x) * Math.sin(heading);
    const turn = yaw - anchor.yaw;
    const { maxLinear, maxLateral = 0, maxAngular } = this.#limits;
    if (free) {
      const model = this.#roll;
      copyMotion(anchor, model);
      this.#lead(model, this.#robotMs, robotMs);
      const [dx, dy] = [model.x - anchor.x, model.y - anchor.y];
      const [cos, sin] = [Math.cos((anchor.yaw + model.yaw) / 2), Math.sin((anchor.yaw + model.yaw) / 2)];
      const modelTravel = dx * cos + dy * sin;
      anchor.lateral = model.lateral + (TRUST * (aside - (dy * cos - dx * sin))) / seconds;
      anchor.linear = model.linear + (TRUST * (travel - modelTravel)) / seconds;
      anchor.angular = model.angular + (TRUST * (turn - (model.yaw - anchor.yaw))) / seconds;
    } else {
      anchor.linear = travel / seconds;
      anchor.lateral = aside / seconds;
      anchor.angular = turn / seconds;
    }
    anchor.linear = within(anchor.linear, maxLinear);
    anchor.lateral = within(anchor.lateral, maxLateral);
    anchor.angular = within(anchor.angular, maxAngular);
    if (free && this.driving) this.#addToWindow(robotMs, travel, turn);
  }

  /** Standing and even motion say nothing new, and would push out what does. */
  #addToWindow(robotMs: number, travel: number, turn: number): void {
    const commands = this.#commands;
    const window = this.#window;
    const changedMs = commands.timeMs(commands.length - 1) + this.#shiftMs;
    if (robotMs - changedMs > EXCITED_MS) return;
    window.add(this.#robotMs, robotMs, travel, turn);
    while (window.length > 0 && (window.from[window.at(0)] as number) - this.#shiftMs < commands.knownSinceMs)
      window.dropOldest();
    this.#fit.improve(this.#fastestMs);
  }

  #jumps(dx: number, dy: number, turn: number, seconds: number): boolean {
    const { maxLinear, maxLateral = 0, maxAngular } = this.#limits;
    const far = Math.hypot(dx, dy) > JUMP_M + 2 * Math.max(maxLinear, maxLateral) * seconds;
    return far || Math.abs(turn) > JUMP_RAD + 2 * maxAngular * seconds;
  }

  #newFit(): ModelFit {
    return new ModelFit(usualBase(USUAL_LOOP_MS, this.#limits), this.#commands, this.#window);
  }
}

/** Share of a lead that is shown: all of a small one; a large one comes to `most`. */
function softly(lead: number, most: number): number {
  return 1 / Math.hypot(1, lead / most);
}

function within(value: number, most: number): number {
  return Math.min(Math.max(value, -most), most);
}
