/**
 * Where a camera sits on the robot: found from the poses of the clouds and of the body, compared at the same instant of the
 * robot's clock. A view at the predicted body then stands where that camera will be. Bounded memory.
 */
import { shortestTurn } from '@farpoint/protocol';

/** At 20 reports a second, 3 s. */
const CAPACITY = 64;
/** Share of a new measurement: interpolated poses are off by millimetres. */
const SHARE = 0.1;
/** A measurement that is off by more begins anew: the camera does not sit where it sat, or is not on the robot; m and rad. */
const ELSEWHERE_M = 0.1;
const ELSEWHERE_RAD = 0.1;
/** So many measurements must agree. */
const LEAST_AGREED = 15;

export interface HeadingPose {
  x: number;
  y: number;
  z: number;
  /** Radians. */
  yaw: number;
}

export class CameraMount {
  /** In base_link: m forward, left and up, and the camera's heading to the left, rad. */
  forward = 0;
  left = 0;
  up = 0;
  turn = 0;
  readonly #times = new Float64Array(CAPACITY);
  readonly #poses = new Float64Array(CAPACITY * 4);
  #count = 0;
  #agreed = -1;
  /** A camera's pose that is younger than the body's newest. */
  readonly #waiting = { ms: Number.NaN, x: 0, y: 0, z: 0, yaw: 0 };

  /** Whether it is known: whether the camera moves with the body. */
  get known(): boolean {
    return this.#agreed >= LEAST_AGREED;
  }

  reset(): void {
    this.#agreed = -1;
    this.#count = 0;
    this.#waiting.ms = Number.NaN;
  }

  /** The body's pose, from telemetry, in order. @param robotMs when it was measured, robot's clock */
  onBody(robotMs: number, x: number, y: number, z: number, yaw: number): void {
    if (this.#count > 0 && robotMs <= this.#timeOf(this.#count - 1)) return;
    const at = this.#count++ % CAPACITY;
    this.#times[at] = robotMs;
    this.#poses[4 * at] = x;
    this.#poses[4 * at + 1] = y;
    this.#poses[4 * at + 2] = z;
    this.#poses[4 * at + 3] = yaw;
    const { ms } = this.#waiting;
    if (ms <= robotMs) {
      this.#waiting.ms = Number.NaN;
      this.#compare(ms, this.#waiting);
    }
  }

  /** The camera's pose when a cloud was captured. @param captureMs robot's clock */
  onCamera(captureMs: number, pose: Readonly<HeadingPose>): void {
    if (this.#count > 0 && captureMs <= this.#timeOf(this.#count - 1)) this.#compare(captureMs, pose);
    else if (Number.isNaN(this.#waiting.ms)) Object.assign(this.#waiting, pose, { ms: captureMs });
  }

  /** Where the camera is when the body is there. Allocates nothing. */
  place(x: number, y: number, z: number, yaw: number, into: HeadingPose): void {
    const cos = Math.cos(yaw);
    const sin = Math.sin(yaw);
    into.x = x + cos * this.forward - sin * this.left;
    into.y = y + sin * this.forward + cos * this.left;
    into.z = z + this.up;
    into.yaw = yaw + this.turn;
  }

  #timeOf(index: number): number {
    return this.#times[index % CAPACITY] as number;
  }

  #compare(ms: number, camera: Readonly<HeadingPose>): void {
    const oldest = Math.max(0, this.#count - CAPACITY);
    let after = this.#count - 1;
    while (after > oldest && this.#timeOf(after - 1) >= ms) after--;
    if (after === oldest) return;
    const [a, b] = [4 * ((after - 1) % CAPACITY), 4 * (after % CAPACITY)];
    const [fromMs, toMs] = [this.#timeOf(after - 1), this.#timeOf(after)];
    const share = (ms - fromMs) / (toMs - fromMs);
    const of = (axis: number) => {
      const from = this.#poses[a + axis] as number;
      return from + ((this.#poses[b + axis] as number) - from) * share;
    };
    const fromYaw = this.#poses[a + 3] as number;
    const yaw = fromYaw + shortestTurn((this.#poses[b + 3] as number) - fromYaw) * share;
    const [dx, dy] = [camera.x - of(0), camera.y - of(1)];
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    this.#take(cos * dx + sin * dy, cos * dy - sin * dx, camera.z - of(2), shortestTurn(camera.yaw - yaw));
  }

  #take(forward: number, left: number, up: number, turn: number): void {
    if (!Number.isFinite(forward + left + up + turn)) return;
    const off = Math.hypot(forward - this.forward, left - this.left, up - this.up);
    const offTurn = shortestTurn(turn - this.turn);
    const anew = this.#agreed < 0 || off > ELSEWHERE_M || Math.abs(offTurn) > ELSEWHERE_RAD;
    this.#agreed = anew ? 0 : this.#agreed + 1;
    const share = anew ? 1 : SHARE;
    this.forward += (forward - this.forward) * share;
    this.left += (left - this.left) * share;
    this.up += (up - this.up) * share;
    this.turn += offTurn * share;
  }
}
