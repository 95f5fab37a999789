/**
 * Where the operator's "ahead" points in the world: fixed, so that a robot that turns does not turn the operator's room
 * about them, or with the robot. Pure, allocates nothing. Angles in radians, counter-clockwise seen from above; places in
 * three.js axes (x right, y up, z back).
 */
export class ViewHeading {
  /** Where ahead points now. */
  yaw = 0;
  /** How far turns about the head have moved the operator's origin, m. */
  shiftX = 0;
  shiftZ = 0;
  readonly #followsRobot: boolean;
  #base: number | null = null;
  #own = 0;

  constructor(followsRobot: boolean) {
    this.#followsRobot = followsRobot;
  }

  /** The robot's next heading becomes the operator's. */
  align(): void {
    this.#base = null;
    this.#own = 0;
    this.shiftX = 0;
    this.shiftZ = 0;
  }

  /** @param robotYaw the robot's heading */
  follow(robotYaw: number): void {
    if (this.#followsRobot || this.#base === null) this.#base = robotYaw;
    this.yaw = this.#base + this.#own;
  }

  /** @param by positive to the left */
  turn(by: number): void {
    this.#own += by;
    this.yaw += by;
  }

  /**
   * Turns about the operator's head, which stays where it is: someone who leans or stands beside the origin does not swing
   * around it.
   *
   * @param x place of the head relative to the operator's origin, m
   * @param z likewise
   */
  turnAbout(by: number, x: number, z: number): void {
    const cos = Math.cos(this.yaw);
    const sin = Math.sin(this.yaw);
    this.turn(by);
    const cosAfter = Math.cos(this.yaw);
    const sinAfter = Math.sin(this.yaw);
    this.shiftX += x * (cos - cosAfter) + z * (sin - sinAfter);
    this.shiftZ += x * (sinAfter - sin) + z * (cos - cosAfter);
  }
}
