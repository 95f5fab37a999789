/**
 * The operator's origin in the space that the headset tracks: where the eyes are at rest, looking ahead. Recentring puts it
 * at the head. Pure, allocates nothing. Axes of three.js and WebXR: x right, y up, z back; m.
 */

interface Point {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

interface Quaternion extends Point {
  readonly w: number;
}

export class OperatorOrigin {
  x = 0;
  y = 0;
  z = 0;
  /** Direction of ahead, radians about the vertical, positive to the left. */
  yaw = 0;

  /** Back to where the headset began. */
  reset(): void {
    this.x = 0;
    this.y = 0;
    this.z = 0;
    this.yaw = 0;
  }

  /** To the head. Ahead becomes where the face points, seen from above. @param orientation of the head, a unit quaternion */
  recentre({ x, y, z }: Point, orientation: Quaternion): void {
    this.x = x;
    this.y = y;
    this.z = z;
    this.yaw = headYaw(orientation);
  }

  /** Right of the origin, m, of a place in the tracked space. */
  rightOf(x: number, z: number): number {
    return (x - this.x) * Math.cos(this.yaw) - (z - this.z) * Math.sin(this.yaw);
  }

  /** Behind the origin, m. */
  behind(x: number, z: number): number {
    return (z - this.z) * Math.cos(this.yaw) + (x - this.x) * Math.sin(this.yaw);
  }

  /** Above the origin, m. */
  above(y: number): number {
    return y - this.y;
  }
}

/** A face that looks up or down as steeply as this share of the vertical has no direction of its own. */
const STEEP = 0.9;

/** Where a face points, seen from above: radians about the vertical, positive to the left. */
export function headYaw({ x, y, z, w }: Quaternion): number {
  // The images of −z (ahead) and of y (the crown).
  const aheadX = -2 * (x * z + w * y);
  const aheadY = -2 * (y * z - w * x);
  const aheadZ = -(1 - 2 * (x * x + y * y));
  if (Math.abs(aheadY) < STEEP) return Math.atan2(-aheadX, -aheadZ) + 0;
  const crownX = 2 * (x * y - w * z);
  const crownZ = 2 * (y * z + w * x);
  // Looking down, the crown points ahead; looking up, it points back.
  return (aheadY < 0 ? Math.atan2(-crownX, -crownZ) : Math.atan2(crownX, crownZ)) + 0;
}
