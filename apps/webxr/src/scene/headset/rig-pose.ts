/**
 * Where the operator's origin is in the robot's world, by view: the eyes at rest, which a recentring makes the origin. Pure,
 * allocates nothing.
 */

/** Over the shoulder: behind the robot's camera and above it, m. */
export const BEHIND_M = 2.4;
export const ABOVE_M = 0.6;

/** A place in the robot's world, REP-103, m. */
export interface WorldPlace {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** A model of the world in the operator's room: axes of three.js, m from the operator's origin. */
export interface ModelPlace {
  /** Where the robot's place on the floor is in the room. */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Metres in the room of one metre of the world. */
  readonly scale: number;
}

export class RigPose {
  /** Place of the operator's origin, three.js axes, m. */
  x = 0;
  y = 0;
  z = 0;
  /** Radians about the vertical, positive to the left. */
  yaw = 0;
  /** Metres of the world that one metre of the room is. */
  scale = 1;

  /**
   * At the robot's camera, at true scale.
   *
   * @param eyeHeight height of the origin in the world, m
   */
  firstPerson(camera: WorldPlace, eyeHeight: number, yaw: number): void {
    this.x = -camera.y;
    this.y = eyeHeight;
    this.z = -camera.x;
    this.yaw = yaw;
    this.scale = 1;
  }

  /** Behind the robot, as the operator faces, and above it. */
  overShoulder(camera: WorldPlace, eyeHeight: number, yaw: number): void {
    this.firstPerson(camera, eyeHeight, yaw);
    this.x += Math.sin(yaw) * BEHIND_M;
    this.z += Math.cos(yaw) * BEHIND_M;
  }

  /**
   * The world is a model in the operator's room.
   *
   * @param x the robot's place in its world, REP-103, m
   * @param y likewise
   * @param ground height of its floor, m
   * @param yaw where ahead in the room points in the world
   */
  tabletop(x: number, y: number, ground: number, model: ModelPlace, yaw: number): void {
    const k = 1 / model.scale;
    const cos = Math.cos(yaw);
    const sin = Math.sin(yaw);
    this.x = -y - k * (model.x * cos + model.z * sin);
    this.y = ground - k * model.y;
    this.z = -x - k * (model.z * cos - model.x * sin);
    this.yaw = yaw;
    this.scale = k;
  }
}
