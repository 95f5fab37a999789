/** Draws where hands aim at the floor in the headset, and tells the other operators of the spot. */
import type { Spot } from '@farpoint/protocol';
import {
  BufferGeometry,
  type Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  type Ray,
  Raycaster,
  Vector3,
} from 'three';
import type { Hand } from '../../ground/headset-settings.ts';
import { texts } from '../../words/language.ts';
import { PLATE_ORDER } from '../headset/text-plate.ts';
import { POINTER_COLOUR, POINTER_HEIGHT_M, pointerRing, ringScale } from '../view/pointer-rings.ts';
import type { RayPointer } from '../view/ray-pointer.ts';
import { type AimBy, FloorAim } from './floor-aim.ts';

/** A ray that ends nowhere is shown so far, in the operator's room, m. Chosen by eye. */
const NOWHERE_M = 2;

/** Where hands can point. */
export interface Floor {
  /** @param ray in the scene's axes @param scale metres of the world in a metre of the operator's room */
  spotAlong(ray: Ray, scale: number): Spot | null;
  /** Tells the others of a spot. @param missed what to say where there is none @returns whether they are told */
  tell(spot: Spot | null, missed: string): boolean;
}

export interface FloorPointerParts {
  readonly rig: Group;
  /** The robot's world. */
  readonly world: Object3D;
  readonly pointer: Pick<RayPointer, 'rays' | 'hands'>;
  readonly floor: Floor;
  /** The hand feels that it has pointed. */
  feel(hand: Hand): void;
}

/** A ray, and the ring where it meets the floor. */
class AimSight {
  readonly #line: Line<BufferGeometry, LineBasicMaterial>;
  readonly #ring: Mesh;

  constructor(ray: Object3D, world: Object3D) {
    const shape = new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, -1)]);
    const look = { color: POINTER_COLOUR, transparent: true, opacity: 0.6, depthTest: false };
    this.#line = new Line(shape, new LineBasicMaterial(look));
    this.#line.renderOrder = PLATE_ORDER.pointer;
    this.#line.frustumCulled = false;
    this.#ring = new Mesh(pointerRing(), new MeshBasicMaterial(look));
    this.hide();
    ray.add(this.#line);
    world.add(this.#ring);
  }

  hide(): void {
    this.#line.visible = false;
    this.#ring.visible = false;
  }

  /** @param distanceM from the hand to the spot, in the operator's room */
  show(spot: Spot | null, distanceM: number, scale: number): void {
    this.#line.visible = true;
    this.#line.scale.z = distanceM;
    this.#ring.visible = spot !== null;
    if (spot === null) return;
    this.#ring.position.set(spot.x, spot.y, spot.z + POINTER_HEIGHT_M);
    this.#ring.scale.setScalar(ringScale(scale));
  }
}

export class FloorPointer {
  readonly #parts: FloorPointerParts;
  readonly #aim = new FloorAim();
  readonly #sights: readonly AimSight[];
  readonly #raycaster = new Raycaster();
  readonly #at = new Vector3();
  /** Where each ray meets the floor; `null`: nowhere, or something else comes first. */
  readonly #spots: (Spot | null)[] = [null, null];

  constructor(parts: FloorPointerParts) {
    this.#parts = parts;
    const { pointer, world } = parts;
    this.#sights = pointer.rays.map((ray) => new AimSight(ray, world));
  }

  get by(): AimBy {
    return this.#aim.by;
  }

  /** Where hands aim that are shown to aim, for tests. */
  get spots(): readonly (Spot | null)[] {
    return this.#spots;
  }

  /** The next trigger or pinch points. */
  arm(nowMs: number): void {
    this.#aim.arm(nowMs);
  }

  /** A trigger was pulled and let go, or a hand has pinched, and is at nothing else. @returns whether it was to point */
  take(ray: number): boolean {
    if (!this.#aim.take()) return false;
    this.#point(ray);
    return true;
  }

  /**
   * Call this before each display frame in VR.
   *
   * @param reading as {@link FloorAim.update} has it
   * @param hand the hand that does not drive
   * @param covered whether each ray is at something before the floor
   */
  update(
    reading: Parameters<FloorAim['update']>[0],
    hand: Hand,
    covered: readonly boolean[],
    nowMs: number,
  ): void {
    const opened = this.#aim.update(reading, nowMs);
    const { hands } = this.#parts.pointer;
    // The hand that has just opened points at where it is now.
    if (opened) this.#point(hands.indexOf(hand), covered);
    for (let ray = 0; ray < this.#sights.length; ray++) {
      const aims = this.#aim.by === 'trigger' || (this.#aim.by === 'grip' && hands[ray] === hand);
      if (aims) this.#look(ray, covered[ray] === true);
      else {
        this.#spots[ray] = null;
        this.#sights[ray]?.hide();
      }
    }
  }

  #point(ray: number, covered: readonly boolean[] = []): void {
    const { floor, pointer, feel } = this.#parts;
    if (ray >= 0) this.#look(ray, covered[ray] === true);
    const hand = pointer.hands[ray];
    const told = floor.tell(this.#spots[ray] ?? null, texts().fleet.pointing.aimRay);
    this.#sights[ray]?.hide();
    if (told && (hand === 'left' || hand === 'right')) feel(hand);
  }

  #look(index: number, isCovered: boolean): void {
    const { rig, world, pointer, floor } = this.#parts;
    const sight = this.#sights[index];
    const ray = pointer.rays[index];
    if (sight === undefined || ray?.visible !== true || isCovered) {
      this.#spots[index] = null;
      sight?.hide();
      return;
    }
    ray.updateWorldMatrix(true, false);
    this.#raycaster.setFromXRController(ray as never);
    const scale = rig.scale.x;
    const spot = floor.spotAlong(this.#raycaster.ray, scale);
    this.#spots[index] = spot;
    const far = spot === null ? null : world.localToWorld(this.#at.set(spot.x, spot.y, spot.z));
    const distanceM = far === null ? NOWHERE_M : far.distanceTo(this.#raycaster.ray.origin) / scale;
    sight.show(spot, distanceM, scale);
  }
}
