import { Group } from 'three';
import { worldToThree } from './axes.ts';

/** The robot's world in a three.js scene. Children are placed in metres, by REP-103 (x forward, y left, z up). */
export class RobotWorld extends Group {
  /** Creates an empty group. Its matrix converts the robot's axes to three's, and three does not update it. */
  constructor() {
    super();
    this.matrixAutoUpdate = false;
    this.matrix.copy(worldToThree());
  }
}
