/** Measures where sheets are in the operator's view. Allocates nothing for each frame. */
import { type Group, Matrix4, type Mesh, type Object3D, Vector3 } from 'three';
import type { ViewBox } from './view-box.ts';

export class ViewFrame {
  readonly #toRig = new Matrix4();
  readonly #eyes = new Vector3();
  readonly #corner = new Vector3();
  #ahead = 0;

  /**
   * Call this before each display frame. What is measured is where it was in the last one.
   *
   * @param rig carries the tracked space
   * @param head a child of the rig
   * @param ahead direction of ahead in the tracked space, radians to the left
   */
  update(rig: Group, head: Object3D, ahead: number): void {
    this.#toRig.copy(rig.matrixWorld).invert();
    this.#eyes.copy(head.position);
    this.#ahead = ahead;
  }

  /** Adds the corners of a sheet to a box. */
  add(sheet: Mesh, box: ViewBox): void {
    const { geometry, matrixWorld } = sheet;
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    const bounds = geometry.boundingBox;
    if (bounds === null) return;
    const { min, max } = bounds;
    for (let corner = 0; corner < 4; corner++) {
      const at = this.#corner.set(corner % 2 === 0 ? min.x : max.x, corner < 2 ? min.y : max.y, 0);
      box.add(at.applyMatrix4(matrixWorld).applyMatrix4(this.#toRig), this.#eyes, this.#ahead);
    }
  }
}
