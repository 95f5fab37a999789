/** The outline of a controller in the operator's hand, so that a label can point to its control. */
import { CylinderGeometry, Group, Mesh, MeshBasicMaterial, SphereGeometry } from 'three';
import type { Hand } from '../../ground/headset-settings.ts';
import type { Control } from '../../words/controller-label-words.ts';
import { controlPlace } from './controller-shape.ts';

const BODY = 0x2b3a47;
const CONTROL = 0xe6edf3;
const STOP = 0xff5d5d;
/** Radius of each control, m. */
const SIZES: readonly (readonly [Control, number])[] = [
  ['stick', 0.008],
  ['upper', 0.005],
  ['lower', 0.005],
  ['trigger', 0.008],
  ['grip', 0.008],
];

export class ControllerFigure {
  /** A child for a grip's space. */
  readonly object = new Group();
  readonly #parts: { material: MeshBasicMaterial; opacity: number }[] = [];

  constructor(hand: Hand) {
    const handle = this.#add(new CylinderGeometry(0.014, 0.012, 0.09, 16), BODY, 0.55);
    handle.rotation.x = -Math.PI / 2;
    handle.position.set(0, -0.008, 0.005);
    const face = this.#add(new CylinderGeometry(0.021, 0.021, 0.01, 24), BODY, 0.7);
    face.position.set(0, 0.004, -0.044);
    for (const [control, radius] of SIZES) {
      const { x, y, z } = controlPlace(control, hand);
      const shape = new SphereGeometry(radius, 16, 12);
      this.#add(shape, control === 'upper' ? STOP : CONTROL, 0.95).position.set(x, y, z);
    }
    this.object.visible = false;
  }

  /** 0: it is gone … 1 */
  set share(share: number) {
    this.object.visible = share > 0;
    for (const { material, opacity } of this.#parts) material.opacity = share * opacity;
  }

  #add(shape: SphereGeometry | CylinderGeometry, colour: number, opacity: number): Mesh {
    const material = new MeshBasicMaterial({ color: colour, opacity, transparent: true });
    const mesh = new Mesh(shape, material);
    this.#parts.push({ material, opacity });
    this.object.add(mesh);
    return mesh;
  }
}
