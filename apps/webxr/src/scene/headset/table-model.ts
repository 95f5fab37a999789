/**
 * The model of the world in the operator's room, and what hands do to it: one hand moves it, two hands move, turn and scale
 * it. It turns about the vertical only, so that floors stay level. Pure, allocates nothing. Places in the room, axes of
 * three.js, m from the operator's origin.
 */

/** The robot's place at first: before and below the eyes, as on a table; ten metres are half a metre. */
const FIRST = { x: 0, y: -0.45, z: -0.6, scale: 0.05 } as const;
export const MODEL_SCALE = { least: 0.005, most: 1 } as const;
/** Hands nearer to each other than this, seen from above, have no direction, m. */
const LEAST_SPREAD_M = 0.03;

/** A hand that may hold the model. */
export interface GrabbingHand {
  readonly holds: boolean;
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export class TableModel {
  /** Where the robot's place on the floor is. */
  x: number = FIRST.x;
  y: number = FIRST.y;
  z: number = FIRST.z;
  /** Metres in the room of one metre of the world. */
  scale: number = FIRST.scale;
  /** By how much the last {@link follow} turned it, radians about the vertical, positive to the left. */
  turned = 0;
  #heldByA = false;
  #heldByB = false;
  // Of the hand that holds, or half-way between both.
  #x = 0;
  #y = 0;
  #z = 0;
  #spread = 0;
  /** Direction from one hand to the other, radians; NaN without one. */
  #direction = Number.NaN;

  /** Places it as at first. */
  reset(): void {
    this.x = FIRST.x;
    this.y = FIRST.y;
    this.z = FIRST.z;
    this.scale = FIRST.scale;
    this.letGo();
  }

  /** A hand that holds later begins anew. */
  letGo(): void {
    this.#heldByA = false;
    this.#heldByB = false;
    this.turned = 0;
  }

  /** Moves the model with the hands that hold it. Call this before each display frame. */
  follow(a: GrabbingHand, b: GrabbingHand): void {
    // A hand that joins or leaves moves nothing by that.
    const goesOn = a.holds === this.#heldByA && b.holds === this.#heldByB;
    this.#heldByA = a.holds;
    this.#heldByB = b.holds;
    this.turned = 0;
    if (a.holds && b.holds) this.#byTwo(a, b, goesOn);
    else if (a.holds) this.#byOne(a, goesOn);
    else if (b.holds) this.#byOne(b, goesOn);
  }

  #byOne(hand: GrabbingHand, goesOn: boolean): void {
    if (goesOn) {
      this.x += hand.x - this.#x;
      this.y += hand.y - this.#y;
      this.z += hand.z - this.#z;
    }
    this.#x = hand.x;
    this.#y = hand.y;
    this.#z = hand.z;
  }

  #byTwo(a: GrabbingHand, b: GrabbingHand, goesOn: boolean): void {
    const x = (a.x + b.x) / 2;
    const y = (a.y + b.y) / 2;
    const z = (a.z + b.z) / 2;
    const spread = Math.hypot(b.x - a.x, b.y - a.y, b.z - a.z);
    const level = Math.hypot(b.x - a.x, b.z - a.z);
    const direction = level < LEAST_SPREAD_M ? Number.NaN : Math.atan2(a.z - b.z, b.x - a.x);
    if (goesOn) {
      const before = this.scale;
      const wider = spread < LEAST_SPREAD_M || this.#spread < LEAST_SPREAD_M ? 1 : spread / this.#spread;
      this.scale = Math.min(Math.max(before * wider, MODEL_SCALE.least), MODEL_SCALE.most);
      const ratio = this.scale / before;
      const by = direction - this.#direction;
      this.turned = Number.isNaN(by) ? 0 : by - 2 * Math.PI * Math.round(by / (2 * Math.PI));
      const cos = Math.cos(this.turned);
      const sin = Math.sin(this.turned);
      const dx = this.x - this.#x;
      const dz = this.z - this.#z;
      this.x = x + ratio * (dx * cos + dz * sin);
      this.y = y + ratio * (this.y - this.#y);
      this.z = z + ratio * (dz * cos - dx * sin);
    }
    this.#x = x;
    this.#y = y;
    this.#z = z;
    this.#spread = spread;
    this.#direction = direction;
  }
}
