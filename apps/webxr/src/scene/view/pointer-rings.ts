/** Rings on the floor where operators point, each with a name above it. */
import {
  CanvasTexture,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
  Sprite,
  SpriteMaterial,
} from 'three';
import type { ShownPointer } from '../../state/pointers.ts';

/** Above the spot, over everything else on the floor, metres. */
const HEIGHT_M = 0.045;
const RING_M = { inner: 0.14, outer: 0.24 };
/** Of the name, metres. Chosen by eye: readable at 5 m. */
const NAME_M = { width: 1, height: 0.2, above: 0.35 };
const NAME_PIXELS = { width: 320, height: 64, font: 40 };
/** Unlike everything that means danger or the robot's own way. */
const COLOUR = '#ff9df5';
const GROUND = '#0b0f14d0';

/** One ring, made once and used for whoever points. */
class PointerRing {
  readonly object = new Group();
  readonly #canvas = Object.assign(document.createElement('canvas'), {
    width: NAME_PIXELS.width,
    height: NAME_PIXELS.height,
  });
  readonly #texture = new CanvasTexture(this.#canvas);
  #name: string | null = null;

  constructor(geometry: RingGeometry, material: MeshBasicMaterial) {
    // Whoever points shows it through whatever stands before it.
    const name = new Sprite(new SpriteMaterial({ map: this.#texture, depthTest: false, transparent: true }));
    name.scale.set(NAME_M.width, NAME_M.height, 1);
    name.position.z = NAME_M.above;
    name.renderOrder = 2;
    const ring = new Mesh(geometry, material);
    ring.renderOrder = 1;
    this.object.add(ring, name);
  }

  show({ name, at }: ShownPointer): void {
    this.object.visible = true;
    this.object.position.set(at.x, at.y, at.z + HEIGHT_M);
    if (name === this.#name) return;
    this.#name = name;
    this.#draw(name);
    this.#texture.needsUpdate = true;
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
    context.fillStyle = COLOUR;
    // A long name is pressed together.
    context.fillText(name, width / 2, height / 2, width - font / 2);
  }
}

export class PointerRings {
  /** In the world's axes. */
  readonly object = new Group();
  readonly #geometry = new RingGeometry(RING_M.inner, RING_M.outer, 40);
  readonly #material = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    depthTest: false,
    side: DoubleSide,
  });
  readonly #rings: PointerRing[] = [];
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
}
