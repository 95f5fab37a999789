/** An arrow at the edge of the view to the side on which the robot's front is, while the operator does not see it. */
import { BufferGeometry, Float32BufferAttribute, Mesh, MeshBasicMaterial } from 'three';

/** Right and down of where the face points, and ahead, m. */
const AT = { x: 0.42, y: -0.12, z: -1 } as const;

export class FrontPointer {
  /** A child of the camera. */
  readonly object: Mesh<BufferGeometry, MeshBasicMaterial>;

  constructor() {
    const arrow = new BufferGeometry();
    arrow.setAttribute('position', new Float32BufferAttribute([0.07, 0, 0, 0, 0.05, 0, 0, -0.05, 0], 3));
    const material = new MeshBasicMaterial({ color: 0x35c9b5, transparent: true, depthTest: false });
    this.object = new Mesh(arrow, material);
    this.object.renderOrder = 1;
    this.object.visible = false;
  }

  /** @param side −1: the front is to the left, 1: to the right, 0: it is in view */
  show(side: -1 | 0 | 1): void {
    const { object } = this;
    object.visible = side !== 0;
    if (side === 0) return;
    object.position.set(side * AT.x, AT.y, AT.z);
    object.rotation.z = side > 0 ? 0 : Math.PI;
  }
}
