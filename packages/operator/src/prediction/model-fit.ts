/**
 * Identifies a base's model on-line: a pattern search that makes the model, driven by the commands that were sent, travel as
 * the robot was seen to travel (output error, Huber's loss). Each report pays for a few trials; it never blocks.
 *
 * Hooke and Jeeves, “Direct search” solution of numerical and statistical problems, J. ACM 8 (1961).
 */
import { type AxisModel, type BaseModel, lagShare, STEP_MS, stepAxis } from './base-model.ts';
import type { CommandHistory } from './command-history.ts';
import type { TravelWindow } from './travel-window.ts';

// `pnpm bench prediction` measures what these numbers give together (docs/prediction.md).

/** Least motion in the window before an axis is fitted, m and rad. */
const LEAST_TRAVEL_M = 0.12;
const LEAST_TURN_RAD = 0.15;
/** Errors of the velocity beyond this count linearly, m/s and rad/s: outliers. */
const LINEAR_SCALE = 0.1;
const ANGULAR_SCALE = 0.2;
/** A trial must be better by this share. */
const GAIN_SHARE = 0.002;
/** Trials per report. They take well under a millisecond (docs/prediction.md). */
const TRIALS = 6;
/** The longest delay that is tried, ms. */
const MAX_DELAY_MS = 1500;

type Part = 'gain' | 'lagS' | 'rise' | 'fall';
const PARTS: readonly Part[] = ['gain', 'lagS', 'rise', 'fall'];
const BOUNDS: Readonly<Record<Part, readonly [least: number, most: number]>> = {
  gain: [0.2, 2.5],
  lagS: [0.005, 1.5],
  rise: [0.1, 20],
  fall: [0.1, 20],
};

/** One number of the model that is searched: the delay in steps of ms, the others by factors. */
interface Knob {
  readonly axis: 'linear' | 'angular' | null;
  readonly part: Part | null;
  step: number;
  readonly leastStep: number;
  direction: 1 | -1;
  failures: number;
}

export class ModelFit {
  readonly model: BaseModel;
  readonly #commands: CommandHistory;
  readonly #window: TravelWindow;
  readonly #knobs: readonly Knob[];
  #turn = 0;

  /** @param model where the search begins; changed in place */
  constructor(model: BaseModel, commands: CommandHistory, window: TravelWindow) {
    this.model = model;
    this.#commands = commands;
    this.#window = window;
    const knob = (axis: Knob['axis'], part: Part | null, step: number, leastStep: number): Knob => ({
      axis,
      part,
      step,
      leastStep,
      direction: 1,
      failures: 0,
    });
    const ofAxis = (axis: 'linear' | 'angular') => PARTS.map((part) => knob(axis, part, 0.3, 0.01));
    this.#knobs = [knob(null, null, 30, 1), ...ofAxis('linear'), ...ofAxis('angular')];
  }

  /** Whether the window has enough motion to tell anything. */
  get excited(): boolean {
    const { travelled, turned } = this.#window;
    return travelled >= LEAST_TRAVEL_M || turned >= LEAST_TURN_RAD;
  }

  /**
   * Makes a few trials.
   *
   * @param fastestMs what the operator's clock showed at the fastest report's arrival, minus the robot's at its measurement
   */
  improve(fastestMs: number): void {
    if (!this.excited) return;
    const { model } = this;
    let linear = this.#cost('linear', fastestMs);
    let angular = this.#cost('angular', fastestMs);
    for (let trial = 0; trial < TRIALS; trial++) {
      const knob = this.#nextKnob();
      const before = this.#read(knob);
      this.#write(
        knob,
        knob.part === null
          ? before + knob.direction * knob.step
          : before * Math.exp(knob.direction * knob.step),
      );
      const nextLinear = knob.axis === 'angular' ? linear : this.#cost('linear', fastestMs);
      const nextAngular = knob.axis === 'linear' ? angular : this.#cost('angular', fastestMs);
      if (nextLinear + nextAngular < (linear + angular) * (1 - GAIN_SHARE)) {
        linear = nextLinear;
        angular = nextAngular;
        knob.failures = 0;
        knob.step = Math.min(knob.step * 1.4, knob.part === null ? 60 : 0.5);
        continue;
      }
      if (knob.part === null) model.delayMs = before;
      else this.#axis(knob)[knob.part] = before;
      knob.direction = knob.direction === 1 ? -1 : 1;
      if (++knob.failures % 2 === 0) knob.step = Math.max(knob.step / 2, knob.leastStep);
    }
  }

  /** The next number that the window can tell something of. */
  #nextKnob(): Knob {
    const { travelled, turned } = this.#window;
    for (;;) {
      const knob = this.#knobs[this.#turn++ % this.#knobs.length] as Knob;
      if (knob.axis === 'linear' && travelled < LEAST_TRAVEL_M) continue;
      if (knob.axis === 'angular' && turned < LEAST_TURN_RAD) continue;
      return knob;
    }
  }

  #axis(knob: Knob): AxisModel {
    return knob.axis === 'angular' ? this.model.angular : this.model.linear;
  }

  #read(knob: Knob): number {
    return knob.part === null ? this.model.delayMs : this.#axis(knob)[knob.part];
  }

  #write(knob: Knob, value: number): void {
    if (knob.part === null) this.model.delayMs = Math.min(Math.max(value, 0), MAX_DELAY_MS);
    else {
      const [least, most] = BOUNDS[knob.part];
      this.#axis(knob)[knob.part] = Math.min(Math.max(value, least), most);
    }
  }

  /** How far the model is from what the robot did, summed over the window. */
  #cost(axisName: 'linear' | 'angular', fastestMs: number): number {
    const isLinear = axisName === 'linear';
    const axis = this.model[axisName];
    const scale = isLinear ? LINEAR_SCALE : ANGULAR_SCALE;
    const commands = this.#commands;
    const window = this.#window;
    const seen = isLinear ? window.travel : window.turn;
    // Operator's clock at sending → robot's clock when the wheels hear of it.
    const shiftMs = this.model.delayMs - fastestMs;
    let cost = 0;
    let velocity = 0;
    let index = -1;
    let untilMs = Number.NaN;
    let stepS = Number.NaN;
    let share = 0;
    for (let i = 0; i < window.length; i++) {
      const at = window.at(i);
      const fromMs = window.from[at] as number;
      const toMs = window.to[at] as number;
      const distance = seen[at] as number;
      const seconds = (toMs - fromMs) / 1000;
      if (fromMs !== untilMs) {
        velocity = distance / seconds;
        index = commands.indexAt(fromMs - shiftMs);
      }
      untilMs = toMs;
      let travelled = 0;
      let nowMs = fromMs;
      while (nowMs < toMs) {
        const edgeMs =
          index + 1 < commands.length ? commands.timeMs(index + 1) + shiftMs : Number.POSITIVE_INFINITY;
        if (edgeMs <= nowMs) {
          index++;
          continue;
        }
        const endMs = Math.min(toMs, edgeMs, nowMs + STEP_MS);
        const dtS = (endMs - nowMs) / 1000;
        const command = isLinear ? commands.linear(index) : commands.angular(index);
        // Most steps are as long as the one before, and the exponential is most of their work.
        if (dtS !== stepS) share = lagShare(axis, dtS);
        stepS = dtS;
        const next = stepAxis(velocity, axis.gain * command, axis, dtS, share);
        travelled += ((velocity + next) / 2) * dtS;
        velocity = next;
        nowMs = endMs;
      }
      const error = Math.abs(travelled - distance) / seconds / scale;
      cost += error <= 1 ? (error * error) / 2 : error - 0.5;
    }
    return cost;
  }
}
