/** Lets the operator choose something in VR: by pointing at it and pulling the trigger, or pinching. */
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
import { PLATE_ORDER } from '../headset/text-plate.ts';

/**
 * How far a pointer reaches, and the radius of its mark, m. Chosen: pictures are at the wrist or right before
 * the operator.
 */
const FARTHEST_M = 4;
const RING_M = 0.008;

/** What a ray hits. */
export type RayHit = Intersection<Object3D>;

export interface Pointed {
  /** What can be pointed at now. Those that come first cover the others. */
  targets(): readonly Object3D[];
  /** This ray, 0 or 1, is at it in this display frame; `null`: at nothing. */
  onPointed(hit: RayHit | null, ray: number): void;
  /** The trigger is pulled at it, or the hand pinches. @param bare whether it is a bare hand */
  onPressed(hit: RayHit | null): void;
  /** The trigger was pulled and let go, or the hand has pinched. */
  onChosen(hit: RayHit | null, bare: boolean, ray: number): void;
  /** The trigger or the hand has opened. */
  onOpened(): void;
}

export class RayPointer {
  readonly #pointed: Pointed;
  /** Children of the rig. */
  readonly rays: readonly Object3D[];
  /** The hand whose ray it is, with a controller or bare; `none` while nobody knows. */
  readonly hands: XRHandedness[] = ['none', 'none'];
  readonly #raycaster = new Raycaster();
  readonly #rig: Group;
  readonly #turn = new Quaternion();
  /** Where a ray hits something. */
  readonly #rings: readonly Mesh[];

  constructor(renderer: WebGLRenderer, rig: Group, pointed: Pointed) {
    this.#pointed = pointed;
    this.#rig = rig;
    this.rays = [0, 1].map((index) => renderer.xr.getController(index));
    this.#rings = this.rays.map(() => {
      const material = new MeshBasicMaterial({ color: 0x35c9b5, transparent: true, depthTest: false });
      const ring = new Mesh(new RingGeometry(RING_M / 2, RING_M), material);
      ring.visible = false;
      ring.renderOrder = PLATE_ORDER.pointer;
      rig.add(ring);
      return ring;
    });
    for (const [index, ray] of this.rays.entries()) this.#listen(ray, index);
  }

  #listen(ray: Object3D, index: number): void {
    const pointed = this.#pointed;
    this.#rig.add(ray);
    const on = (type: string, act: (event: { data?: XRInputSource }) => void) =>
      ray.addEventListener(type as never, act as never);
    on('selectstart', () => pointed.onPressed(this.#hit(ray)));
    on('select', ({ data }) => pointed.onChosen(this.#hit(ray), data?.hand != null, index));
    on('selectend', () => pointed.onOpened());
    on('connected', ({ data }) => {
      this.hands[index] = data?.handedness ?? 'none';
    });
    on('disconnected', () => {
      this.hands[index] = 'none';
      pointed.onOpened();
    });
  }

  /** Shows what is pointed at. Call this before each display frame in VR. */
  update(): void {
    for (const [index, ray] of this.rays.entries()) {
      const ring = this.#rings[index] as Mesh;
      const hit = ray.visible ? this.#hit(ray) : null;
      this.#pointed.onPointed(hit, index);
      ring.visible = hit !== null;
      if (hit === null) continue;
      ring.position.copy(ring.parent!.worldToLocal(hit.point));
      hit.object.getWorldQuaternion(ring.quaternion);
      ring.quaternion.premultiply(ring.parent!.getWorldQuaternion(this.#turn).invert());
    }
  }

  /** Whether this controller points at anything that can be chosen. */
  points(index: number): boolean {
    const ray = this.rays[index];
    return ray !== undefined && this.#hit(ray) !== null;
  }

  #hit(ray: Object3D): RayHit | null {
    ray.updateWorldMatrix(true, false);
    // The operator's metre may be many of the world's.
    this.#raycaster.far = FARTHEST_M * this.#rig.scale.x;
    this.#raycaster.setFromXRController(ray as never);
    for (const target of this.#pointed.targets()) {
      if (!target.visible) continue;
      const [hit] = this.#raycaster.intersectObject(target, false);
      if (hit !== undefined) return hit;
    }
    return null;
  }
}
