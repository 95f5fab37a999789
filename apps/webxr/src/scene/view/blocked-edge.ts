/** Red at the edge of the operator's view, in the direction in which the robot is not let go. */
import {
  type Camera,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  type PerspectiveCamera,
  Quaternion,
  RingGeometry,
  Vector3,
} from 'three';

const [direction, axis] = [new Vector3(), new Vector3()];
const [bodyTurn, cameraTurn] = [new Quaternion(), new Quaternion()];

/**
 * Where a direction of the robot is on the screen: radians counter-clockwise from up.
 *
 * @param bearing radians to the left of straight ahead @param body at base_link, REP-103 axes
 * @param fromAbove whether the camera looks straight down
 */
export function bearingOnScreen(bearing: number, body: Object3D, camera: Camera, fromAbove: boolean): number {
  direction.set(Math.cos(bearing), Math.sin(bearing), 0).applyQuaternion(body.getWorldQuaternion(bodyTurn));
  camera.getWorldQuaternion(cameraTurn);
  const right = direction.dot(axis.set(1, 0, 0).applyQuaternion(cameraTurn));
  // Straight ahead of who looks level is up.
  const ahead = fromAbove ? axis.set(0, 1, 0).applyQuaternion(cameraTurn) : level(cameraTurn);
  return Math.atan2(-right, direction.dot(ahead));
}

/** Where the camera looks, without how far up or down. */
function level(turn: Quaternion): Vector3 {
  axis.set(0, 0, -1).applyQuaternion(turn).setY(0);
  return axis.lengthSq() < 1e-6 ? axis.set(0, 1, 0).applyQuaternion(turn) : axis.normalize();
}

/** Half of how much of the view's edge is red, radians. Chosen by eye. */
const HALF = Math.PI / 7;

/** In the headset: a part of a ring around the middle of the view, before everything else. */
export class BlockedArc {
  readonly #mesh: Mesh<RingGeometry, MeshBasicMaterial>;

  constructor(camera: PerspectiveCamera) {
    this.#mesh = new Mesh(
      new RingGeometry(0.56, 0.72, 24, 1, Math.PI / 2 - HALF, 2 * HALF),
      new MeshBasicMaterial({
        color: 0xff3b3b,
        transparent: true,
        opacity: 0.6,
        side: DoubleSide,
        forceSinglePass: true,
        depthTest: false,
        depthWrite: false,
      }),
    );
    this.#mesh.position.z = -1;
    this.#mesh.renderOrder = 10;
    this.#mesh.visible = false;
    camera.add(this.#mesh);
  }

  /** @param bearing on the screen, counter-clockwise from up; `null` for nothing */
  show(bearing: number | null): void {
    this.#mesh.visible = bearing !== null;
    if (bearing !== null) this.#mesh.rotation.z = bearing;
  }
}
