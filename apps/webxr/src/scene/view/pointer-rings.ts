/** Rings on the floor where operators point, each with a name above it. */
import {
  CanvasTexture,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  RingGeometry,
  Sprite,
  SpriteMaterial,
  Vector3,
} from 'three';
import type { ShownPointer } from '../../state/pointers.ts';

/** Above the spot, over everything else on the floor, metres. */
export const POINTER_HEIGHT_M = 0.045;
const RING_M = { inner: 0.14, outer: 0.24 };
/** Of the name, metres. Chosen by eye: readable at 5 m. */
const NAME_M = { width: 1, height: 0.2, above: 0.35 };
const NAME_PIXELS = { width: 320, height: 64, font: 40 };
/** In the headset a name is as large at each distance as it is here at this one, m: its capitals have 1°. */
const NAME_AT_M = 5;
/** In a model that is smaller than 1:20, rings do not become smaller with it. Chosen by eye. */
const SMALLEST_MODEL = 20;
/** Unlike everything that means danger or the robot's own way. */
export const POINTER_COLOUR = '#ff9df5';
const GROUND = '#0b0f14d0';

export function pointerRing(): RingGeometry {
  return new RingGeometry(RING_M.inner, RING_M.outer, 40);
}

/** How much larger a ring is than on the flat screen. @param scale metres of the world in a metre of the operator's room */
export function ringScale(scale: number): number {
  return Math.max(1, scale / SMALLEST_MODEL);
}

/** One ring, made once and used for whoever points. */
class PointerRing {
  readonly object = new Group();
  readonly #canvas = Object.assign(document.createElement('canvas'), {
    width: NAME_PIXELS.width,
    height: NAME_PIXELS.height,
  });
  readonly #texture = new CanvasTexture(this.#canvas);
  readonly #ring: Mesh;
  readonly #label: Sprite;
  #name: string | null = null;

  constructor(geometry: RingGeometry, material: MeshBasicMaterial) {
    // Whoever points shows it through whatever stands before it.
    const name = new Sprite(new SpriteMaterial({ map: this.#texture, depthTest: false, transparent: true }));
    name.scale.set(NAME_M.width, NAME_M.height, 1);
    name.position.z = NAME_M.above;
    name.renderOrder = 2;
    const ring = new Mesh(geometry, material);
    ring.renderOrder = 1;
    this.#ring = ring;
    this.#label = name;
    this.object.add(ring, name);
  }

  show({ name, at }: ShownPointer): void {
    this.object.visible = true;
    this.object.position.set(at.x, at.y, at.z + POINTER_HEIGHT_M);
    if (name === this.#name) return;
    this.#name = name;
    this.#draw(name);
    this.#texture.needsUpdate = true;
  }

  /** @param large how much larger the name is than at its usual size, in the operator's room @param scale as {@link ringScale} has it */
  fit(large: number, scale: number): void {
    this.#ring.scale.setScalar(ringScale(scale));
    // A sprite's size is not the world's, but the room's.
    this.#label.scale.set(NAME_M.width * large, NAME_M.height * large, 1);
    this.#label.position.z = Math.max(NAME_M.above * ringScale(scale), NAME_M.height * large * scale);
  }

  #draw(name: string): void {
    const context = this.#canvas.getContext('2d');
    if (context === null) return;
    const { width, height, font } = NAME_PIXELS;
    context.clearRect(0, 0, width, height);
    context.font = `600 ${font}px system-ui, sans-serif`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const wide = Math.min(width, context.measureText(name).width + font);
    context.fillStyle = GROUND;
    context.fillRect((width - wide) / 2, 0, wide, height);
    context.fillStyle = POINTER_COLOUR;
    // A long name is pressed together.
    context.fillText(name, width / 2, height / 2, width - font / 2);
  }
}

export class PointerRings {
  /** In the world's axes. */
  readonly object = new Group();
  readonly #geometry = pointerRing();
  readonly #material = new MeshBasicMaterial({
    color: POINTER_COLOUR,
    transparent: true,
    depthTest: false,
    side: DoubleSide,
  });
  readonly #rings: PointerRing[] = [];
  readonly #eyes = new Vector3();
  #shown: readonly ShownPointer[] = [];

  /** Who is shown to point, and where. */
  get shown(): readonly ShownPointer[] {
    return this.#shown;
  }

  show(pointers: readonly ShownPointer[]): void {
    this.#shown = pointers;
    while (this.#rings.length < pointers.length) {
      const ring = new PointerRing(this.#geometry, this.#material);
      this.#rings.push(ring);
      this.object.add(ring.object);
    }
    for (const [i, ring] of this.#rings.entries()) {
      const pointer = pointers[i];
      if (pointer === undefined) ring.object.visible = false;
      else ring.show(pointer);
    }
  }

  /**
   * Makes names readable from where they are seen, in VR from any distance. Call this before each display frame.
   *
   * @param head the operator's in VR; `null` on the flat screen
   * @param scale metres of the world in a metre of the operator's room
   */
  fit(head: Object3D | null, scale: number): void {
    if (this.#shown.length === 0) return;
    if (head !== null) this.object.worldToLocal(head.getWorldPosition(this.#eyes));
    for (let index = 0; index < this.#shown.length; index++) {
      const ring = this.#rings[index];
      const away =
        ring === undefined || head === null ? NAME_AT_M : ring.object.position.distanceTo(this.#eyes) / scale;
      ring?.fit(away / NAME_AT_M, scale);
    }
  }
}
