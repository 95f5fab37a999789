/** The view from above: straight down on the robot, which stays in the middle of the screen. */
import { OrthographicCamera } from 'three';

/** Distance from the robot's ground up to the camera, metres. Whatever is less far above or below it is in view. */
const HEIGHT_M = 100;
/** Direction of north in the world (REP-103: x east, y north), counter-clockwise from x, radians. */
const NORTH = Math.PI / 2;

export interface TopDownPlace {
  /** The robot's base_link in its world, metres. */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Its heading, counter-clockwise from the world's x axis, radians. */
  readonly yaw: number;
}

export interface TopDownLook {
  /** The robot's heading is up; otherwise north. */
  readonly headingUp: boolean;
  /** Metres from the robot to the nearest edge of the screen. */
  readonly reach: number;
  /** The screen's width ÷ its height. */
  readonly aspect: number;
}

export class TopDownCamera {
  /** In three.js axes; belongs to the scene's root. */
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 2 * HEIGHT_M);

  constructor() {
    this.camera.rotation.order = 'YXZ';
  }

  place({ x, y, z, yaw }: TopDownPlace, { headingUp, reach, aspect }: TopDownLook): void {
    const { camera } = this;
    const [right, top] = [reach * Math.max(aspect, 1), reach / Math.min(aspect, 1)];
    camera.position.set(-y, z + HEIGHT_M, -x);
    camera.rotation.set(-Math.PI / 2, headingUp ? yaw : NORTH, 0);
    camera.updateMatrixWorld();
    if (camera.right === right && camera.top === top) return;
    Object.assign(camera, { left: -right, right, top, bottom: -top });
    camera.updateProjectionMatrix();
  }
}
