import { Group } from 'three';
import { worldToThree } from './axes.ts';

/** The robot's world in a three.js scene: what is added to it is placed in metres by REP-103 (x forward, y left, z up). */
export class RobotWorld extends Group {
  /** Makes an empty group. Its matrix turns the robot's axes into three's and is not updated by three. */
  constructor() {
    super();
    this.matrixAutoUpdate = false;
    this.matrix.copy(worldToThree());
  }
}
