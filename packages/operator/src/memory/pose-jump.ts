/** Notices poses that the robot cannot have driven to: its localisation has jumped, and places do not mean the same. */
import type { KeyFrame } from './key-frame.ts';

/** The most that a robot moves by itself; faster ones count as jumps. */
export interface MotionLimits {
  /** m/s */
  linear: number;
  /** rad/s */
  angular: number;
}

/** A robot may be moved by others, and its camera is not in the middle about which it turns. */
const TOLERANCE = 2;
/** What localisation corrects by itself without making two walls of one, metres and radians. */
const SLACK_M = 0.25;
const SLACK_RAD = 0.3;
/** Distance of a camera from the robot's axis of turning, metres. */
const LEVER_M = 0.5;

/** Where a sensor's last frame was captured, and when. */
interface LastPose {
  readonly pose: Float64Array;
  arrivedMs: number;
  capturedUs: number;
}

export class PoseJump {
  limits: MotionLimits;
  /** By sensor number. */
  readonly #last = new Map<number, LastPose>();

  constructor(limits: MotionLimits) {
    this.limits = limits;
  }

  reset(): void {
    this.#last.clear();
  }

  /** Whether the sensor cannot have come here from where its last frame was captured. Other sensors then begin anew. */
  isJump(frame: KeyFrame): boolean {
    const last = this.#last.get(frame.sensor);
    const isJump = last !== undefined && this.#isBeyond(frame, last);
    if (isJump) this.#last.clear();
    const now = last ?? { pose: new Float64Array(7), arrivedMs: 0, capturedUs: 0 };
    for (let i = 0; i < 7; i++) now.pose[i] = frame.pose(i);
    now.arrivedMs = frame.arrivedMs;
    now.capturedUs = frame.capturedUs;
    this.#last.set(frame.sensor, now);
    return isJump;
  }

  #isBeyond(frame: KeyFrame, { pose, arrivedMs, capturedUs }: LastPose): boolean {
    const capturedS = ((frame.capturedUs - capturedUs) >>> 0) / 1e6;
    // Some robots do not say when they captured; a frame that was captured before the last wraps to an hour.
    const arrivedS = Math.max((frame.arrivedMs - arrivedMs) / 1000, 0);
    const seconds = Math.max(arrivedS, capturedS < 60 ? capturedS : 0);
    let moved = 0;
    for (let i = 0; i < 3; i++) moved += (frame.pose(i) - (pose[i] as number)) ** 2;
    let dot = 0;
    for (let i = 3; i < 7; i++) dot += frame.pose(i) * (pose[i] as number);
    const turned = 2 * Math.acos(Math.min(Math.abs(dot), 1));
    const { linear, angular } = this.limits;
    const mostM = TOLERANCE * (linear + angular * LEVER_M) * seconds + SLACK_M;
    return Math.sqrt(moved) > mostM || turned > TOLERANCE * angular * seconds + SLACK_RAD;
  }
}
