/**
 * What the operator reads in VR is drawn after everything of the robot's world, whatever lies nearer: a cloud's points or a
 * camera's picture must not cover a reading. Among panels the order says which covers which.
 */
import type { Material, Object3D } from 'three';

/** Above all that the world draws; the later of two covers the other. */
export const PANEL_ORDER = {
  frontPicture: 20,
  controller: 21,
  wristPicture: 22,
  wrist: 23,
  label: 24,
  menu: 30,
  menuMark: 31,
  notice: 40,
  pointer: 50,
} as const;
export type PanelOrder = (typeof PANEL_ORDER)[keyof typeof PANEL_ORDER];

/** Draws it over the world. It also becomes transparent: three.js draws what is opaque first, whatever its order. */
export function drawOverWorld(object: Object3D & { material: Material }, order: PanelOrder): void {
  object.renderOrder = order;
  object.material.transparent = true;
  object.material.depthTest = false;
  object.material.depthWrite = false;
}
