import type { Twist } from '@farpoint/protocol';
import type { FloorPose } from '../../obstacles/sensor-grid.ts';

/** A robot on the floor that does at once what it is told. */
export class Unicycle {
  pose: FloorPose = { x: 0, y: 0, yaw: 0 };

  go({ linear, angular }: Readonly<Twist>, seconds: number): void {
    const { x, y, yaw } = this.pose;
    const heading = yaw + (angular.z * seconds) / 2;
    const way = linear.x * seconds;
    this.pose = {
      x: x + way * Math.cos(heading),
      y: y + way * Math.sin(heading),
      yaw: yaw + angular.z * seconds,
    };
  }
}
