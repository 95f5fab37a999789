/** Lets the operator choose a panel in VR, or a row of it: by pointing at it and pulling the trigger, or pinching. */
import {
  type Group,
  type Intersection,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Quaternion,
  Raycaster,
  RingGeometry,
  type WebGLRenderer,
} from 'three';
import { drawOverWorld, PANEL_ORDER } from './panel-order.ts';

const FARTHEST_M = 4;
const RING_M = 0.008;

/** What a ray hits. */
export type PointerHit = Intersection<Object3D>;

export interface Pointed {
  /** What can be pointed at now. */
  targets(): readonly Object3D[];
  /** The trigger was pulled at it. */
  onChosen(hit: PointerHit): void;
  /** This ray, 0 or 1, is at it in this display frame. */
  onPointed(hit: PointerHit, ray: number): void;
}

export class PicturePointer {
  readonly #pointed: Pointed;
  readonly #rays: readonly Object3D[];
  readonly #raycaster = new Raycaster();
  readonly #rig: Group;
  readonly #turn = new Quaternion();
  /** Where a ray hits a picture. */
  readonly #rings: readonly Mesh[];

  constructor(renderer: WebGLRenderer, rig: Group, pointed: Pointed) {
    this.#pointed = pointed;
    this.#rig = rig;
    this.#rays = [0, 1].map((index) => renderer.xr.getController(index));
    this.#rings = this.#rays.map(() => {
      const material = new MeshBasicMaterial({ color: 0x35c9b5 });
      const ring = new Mesh(new RingGeometry(RING_M / 2, RING_M), material);
      ring.visible = false;
      drawOverWorld(ring, PANEL_ORDER.pointer);
      rig.add(ring);
      return ring;
    });
    for (const ray of this.#rays) {
      rig.add(ray);
      ray.addEventListener('select' as never, () => {
        const hit = this.#hit(ray);
        if (hit !== undefined) pointed.onChosen(hit);
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
      this.#pointed.onPointed(hit, index);
      ring.position.copy(ring.parent!.worldToLocal(hit.point));
      hit.object.getWorldQuaternion(ring.quaternion);
      ring.quaternion.premultiply(ring.parent!.getWorldQuaternion(this.#turn).invert());
    }
  }

  /** Whether this controller points at anything that can be chosen. */
  points(index: number): boolean {
    const ray = this.#rays[index];
    return ray !== undefined && this.#hit(ray) !== undefined;
  }

  #hit(ray: Object3D): PointerHit | undefined {
    ray.updateWorldMatrix(true, false);
    // The operator's metre may be many of the world's.
    this.#raycaster.far = FARTHEST_M * this.#rig.scale.x;
    this.#raycaster.setFromXRController(ray as never);
    const shown = this.#pointed.targets().filter(({ visible }) => visible);
    return this.#raycaster.intersectObjects([...shown], false)[0];
  }
}
