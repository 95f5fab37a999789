/** The hands that hold the model on the table. A hand grabs with the trigger or by pinching, never with the drive grip. */
import { type Group, Mesh, MeshBasicMaterial, SphereGeometry, type WebGLRenderer } from 'three';
import type { OperatorOrigin } from './operator-origin.ts';
import type { GrabbingHand } from './table-model.ts';

const OPEN = 0x35c9b5;
const HOLDING = 0xffffff;
/** Radius of the mark in a hand, metres. Chosen by eye: the tip of a thumb. */
const MARK_M = 0.012;

class Hand implements GrabbingHand {
  holds = false;
  x = 0;
  y = 0;
  z = 0;
  readonly grip: Group;
  readonly mark: Mesh<SphereGeometry, MeshBasicMaterial>;

  constructor(grip: Group) {
    this.grip = grip;
    this.mark = new Mesh(new SphereGeometry(MARK_M, 16, 12), new MeshBasicMaterial({ color: OPEN }));
    this.mark.visible = false;
    grip.add(this.mark);
  }
}

export class GrabbingHands {
  readonly #hands: readonly [Hand, Hand];
  readonly #mayGrab: (index: number) => boolean;

  /**
   * @param rig carries the tracked space
   * @param mayGrab whether this controller's trigger, which is just being pulled, takes hold of the model
   */
  constructor(renderer: WebGLRenderer, rig: Group, mayGrab: (index: number) => boolean) {
    this.#mayGrab = mayGrab;
    this.#hands = [this.#hand(renderer, rig, 0), this.#hand(renderer, rig, 1)];
  }

  get a(): GrabbingHand {
    return this.#hands[0];
  }

  get b(): GrabbingHand {
    return this.#hands[1];
  }

  /** Whether any hand holds the model. */
  get hold(): boolean {
    return this.#hands[0].holds || this.#hands[1].holds;
  }

  letGo(): void {
    this.#hands[0].holds = false;
    this.#hands[1].holds = false;
  }

  /**
   * Takes note of where the hands are. A hand that is no longer tracked lets go. Call this before each display frame.
   *
   * @param shown whether the model is there to be grabbed
   */
  update(origin: OperatorOrigin, shown: boolean): void {
    for (const hand of this.#hands) {
      const { grip, mark } = hand;
      if (!shown || !grip.visible) hand.holds = false;
      hand.x = origin.rightOf(grip.position.x, grip.position.z);
      hand.y = origin.above(grip.position.y);
      hand.z = origin.behind(grip.position.x, grip.position.z);
      mark.visible = shown;
      mark.material.color.setHex(hand.holds ? HOLDING : OPEN);
    }
  }

  #hand(renderer: WebGLRenderer, rig: Group, index: number): Hand {
    const grip = renderer.xr.getControllerGrip(index);
    rig.add(grip);
    const hand = new Hand(grip);
    const letGo = () => {
      hand.holds = false;
    };
    grip.addEventListener('selectstart', () => {
      hand.holds = this.#mayGrab(index);
    });
    grip.addEventListener('selectend', letGo);
    grip.addEventListener('disconnected', letGo);
    return hand;
  }
}
