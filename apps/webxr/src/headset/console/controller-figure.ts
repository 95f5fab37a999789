/** The outline of a controller in the operator's hand, so that a label can point to its control. */
import { CylinderGeometry, Group, Mesh, MeshBasicMaterial, SphereGeometry } from 'three';
import type { Control } from '../../status/controller-label-words.ts';
import { drawOverWorld, PANEL_ORDER } from '../../view/panel-order.ts';
import { controlPlace } from './controller-shape.ts';

const BODY = 0x2b3a47;
const CONTROL = 0xe6edf3;
const STOP = 0xff5d5d;
/** Radius of each control, m. */
const SIZES: Readonly<Partial<Record<Control, number>>> = {
  ...{ stick: 0.008, upper: 0.005, lower: 0.005, trigger: 0.008, grip: 0.008 },
};

/** @returns a child for a grip's space */
export function controllerFigure(hand: 'left' | 'right'): Group {
  const figure = new Group();
  const add = (shape: SphereGeometry | CylinderGeometry, colour: number, opacity: number) => {
    const mesh = new Mesh(shape, new MeshBasicMaterial({ color: colour, opacity }));
    drawOverWorld(mesh, PANEL_ORDER.controller);
    figure.add(mesh);
    return mesh;
  };
  const handle = add(new CylinderGeometry(0.014, 0.012, 0.09, 16), BODY, 0.55);
  handle.rotation.x = -Math.PI / 2;
  handle.position.set(0, -0.008, 0.005);
  const face = add(new CylinderGeometry(0.021, 0.021, 0.01, 24), BODY, 0.7);
  face.position.set(0, 0.004, -0.044);
  for (const [control, radius] of Object.entries(SIZES) as [Control, number][]) {
    const { x, y, z } = controlPlace(control, hand);
    const knob = add(new SphereGeometry(radius, 16, 12), control === 'upper' ? STOP : CONTROL, 0.95);
    knob.position.set(x, y, z);
  }
  return figure;
}
