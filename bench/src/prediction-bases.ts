/** Bases that `pnpm bench prediction` drives. None of them is what the predictor assumes of a robot that it does not know. */
import { zeroTwist } from '@farpoint/protocol';
import { SimulatedBase, type WorldDescription } from '@farpoint/sim';

export interface DrivenBase {
  /** m and rad, of base_link in the world. */
  readonly pose: { x: number; y: number; yaw: number };
  command(linear: number, angular: number): void;
  step(seconds: number): void;
}

const baseKinds = [
  'sim', // the simulator's base, whose acceleration is limited
  'sluggish', // a base with a long lag, a dead zone, and less speed than it is told
] as const;
export type BaseKind = (typeof baseKinds)[number];

const FLOOR: WorldDescription = {
  name: 'floor',
  start: { x: 0, y: 0, yaw: 0 },
  lampSpacing: 4,
  materials: {},
  boxes: [],
  panels: [],
  ellipsoids: [],
  movers: [],
};

export function newBase(kind: BaseKind): DrivenBase {
  return kind === 'sim' ? new PlainFloorBase() : new SluggishBase();
}

class PlainFloorBase implements DrivenBase {
  readonly #base = new SimulatedBase(FLOOR);

  get pose() {
    const { pose, yaw } = this.#base.state;
    return { x: pose.position.x, y: pose.position.y, yaw };
  }

  command(linear: number, angular: number): void {
    const twist = zeroTwist();
    twist.linear.x = linear;
    twist.angular.z = angular;
    this.#base.setCommand(twist);
  }

  step(seconds: number): void {
    this.#base.step(seconds);
  }
}

const DEAD_LINEAR = 0.06;
const DEAD_ANGULAR = 0.1;

class SluggishBase implements DrivenBase {
  readonly pose = { x: 0, y: 0, yaw: 0 };
  #linear = 0;
  #angular = 0;
  #wantedLinear = 0;
  #wantedAngular = 0;

  command(linear: number, angular: number): void {
    this.#wantedLinear = Math.abs(linear) < DEAD_LINEAR ? 0 : 0.85 * linear;
    this.#wantedAngular = Math.abs(angular) < DEAD_ANGULAR ? 0 : 0.75 * angular;
  }

  step(seconds: number): void {
    const limited = (difference: number, lagS: number, most: number) =>
      Math.min(Math.max((difference * seconds) / lagS, -most * seconds), most * seconds);
    this.#linear += limited(this.#wantedLinear - this.#linear, 0.4, 2.5);
    this.#angular += limited(this.#wantedAngular - this.#angular, 0.25, 4);
    const { pose } = this;
    const heading = pose.yaw + (this.#angular * seconds) / 2;
    pose.x += this.#linear * seconds * Math.cos(heading);
    pose.y += this.#linear * seconds * Math.sin(heading);
    pose.yaw += this.#angular * seconds;
  }
}
