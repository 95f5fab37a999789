/** Lets the operator choose a picture in VR: by pointing at it and pulling the trigger. */
import {
  type Group,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Quaternion,
  Raycaster,
  RingGeometry,
  type WebGLRenderer,
} from 'three';

/**
 * How far a pointer reaches, and the radius of its mark, m. Chosen: pictures are at the wrist or right before
 * the operator.
 */
const FARTHEST_M = 4;
const RING_M = 0.008;

/** Calls `onChosen` with the object that the trigger was pulled at. */
export class PicturePointer {
  readonly #targets: () => readonly Object3D[];
  readonly #rays: readonly Object3D[];
  readonly #raycaster = new Raycaster();
  readonly #rig: Group;
  readonly #turn = new Quaternion();
  /** Where a ray hits a picture. */
  readonly #rings: readonly Mesh[];

  constructor(
    renderer: WebGLRenderer,
    rig: Group,
    targets: () => readonly Object3D[],
    onChosen: (object: Object3D) => void,
  ) {
    this.#targets = targets;
    this.#rig = rig;
    this.#rays = [0, 1].map((index) => renderer.xr.getController(index));
    this.#rings = this.#rays.map(() => {
      const material = new MeshBasicMaterial({ color: 0x35c9b5, depthTest: false });
      const ring = new Mesh(new RingGeometry(RING_M / 2, RING_M), material);
      ring.visible = false;
      ring.renderOrder = 1;
      rig.add(ring);
      return ring;
    });
    for (const ray of this.#rays) {
      rig.add(ray);
      ray.addEventListener('select' as never, () => {
        const object = this.#hit(ray)?.object;
        if (object !== undefined) onChosen(object);
      });
    }
  }

  /** Shows what is pointed at. Call this before each display frame in VR. */
  update(): void {
    for (const [index, ray] of this.#rays.entries()) {
      const ring = this.#rings[index] as Mesh;
      const hit = ray.visible ? this.#hit(ray) : undefined;
      ring.visible = hit !== undefined;
      if (hit === undefined) continue;
      ring.position.copy(ring.parent!.worldToLocal(hit.point));
      hit.object.getWorldQuaternion(ring.quaternion);
      ring.quaternion.premultiply(ring.parent!.getWorldQuaternion(this.#turn).invert());
    }
  }

  /** Whether this controller points at a picture. */
  pointsAtPicture(index: number): boolean {
    const ray = this.#rays[index];
    return ray !== undefined && this.#hit(ray) !== undefined;
  }

  #hit(ray: Object3D) {
    ray.updateWorldMatrix(true, false);
    // The operator's metre may be many of the world's.
    this.#raycaster.far = FARTHEST_M * this.#rig.scale.x;
    this.#raycaster.setFromXRController(ray as never);
    const shown = this.#targets().filter(({ visible }) => visible);
    return this.#raycaster.intersectObjects([...shown], false)[0];
  }
}
