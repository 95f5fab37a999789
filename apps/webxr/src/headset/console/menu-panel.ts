/** Draws the headset's menu where the operator looks when it opens, and says which row a ray hits. */
import { effect } from '@preact/signals-core';
import { Group, Mesh, MeshBasicMaterial, type Object3D, PlaneGeometry, Vector3 } from 'three';
import { drawOverWorld, PANEL_ORDER } from '../../view/panel-order.ts';
import { TextPlate } from '../../view/text-plate.ts';
import type { MenuPage } from './menu-page.ts';
import type { MenuState } from './menu-state.ts';

const WIDTH = 1000;
const PIXELS_PER_METRE = 1500;
const ROW = 96;
const MOST_ROWS = 13;
const SIZE = 48;
const EDGE = 36;
const DISTANCE_M = 1.15;
/** Of its middle below the eyes, m. */
const BELOW_M = 0.02;
/** In so many frames it finds its place: what is known of the head is a frame old. */
const PLACED_IN = 2;

export class MenuPanel {
  /** A child of the rig. */
  readonly object = new Group();
  readonly #plate = new TextPlate(
    { width: WIDTH, height: MOST_ROWS * ROW, pixelsPerMetre: PIXELS_PER_METRE },
    PANEL_ORDER.menu,
  );
  readonly #mark: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #ahead = new Vector3();
  #rows = 0;
  #unplaced = 0;

  constructor(menu: MenuState) {
    const plane = new PlaneGeometry(WIDTH / PIXELS_PER_METRE, ROW / PIXELS_PER_METRE);
    this.#mark = new Mesh(plane, new MeshBasicMaterial({ color: 0x35c9b5, opacity: 0.3 }));
    drawOverWorld(this.#mark, PANEL_ORDER.menuMark);
    this.object.add(this.#plate.mesh, this.#mark);
    this.object.visible = false;
    effect(() => {
      const page = menu.page.value;
      this.object.visible = page !== null;
      if (page !== null) this.#draw(page);
    });
    effect(() => {
      this.#mark.position.y = -((menu.marked.value + 1.5) * ROW) / PIXELS_PER_METRE;
    });
  }

  /** What a ray can hit. */
  get target(): Object3D {
    return this.#plate.mesh;
  }

  /** It goes to where the operator looks in the next frames. */
  placeAnew(): void {
    this.#unplaced = PLACED_IN;
  }

  /** Call this before each display frame in VR. @param head in the same space */
  update(head: Object3D): void {
    if (this.#unplaced === 0) return;
    this.#unplaced--;
    this.#place(head);
  }

  /** Before the eyes, upright. */
  #place(head: Object3D): void {
    const ahead = this.#ahead.set(0, 0, -1).applyQuaternion(head.quaternion);
    const yaw = Math.atan2(-ahead.x, -ahead.z);
    this.object.rotation.y = yaw;
    this.object.position.set(
      head.position.x - Math.sin(yaw) * DISTANCE_M,
      head.position.y - BELOW_M + (this.#rows * ROW) / 2 / PIXELS_PER_METRE,
      head.position.z - Math.cos(yaw) * DISTANCE_M,
    );
  }

  /** The row that was hit; −1 for the title. @param v of the hit, 1 at the upper edge */
  rowAt(v: number): number {
    return Math.floor((1 - v) * this.#rows) - 1;
  }

  /** Middle of each row, in the world. */
  rowPlaces(): Vector3[] {
    this.object.updateWorldMatrix(true, false);
    return Array.from({ length: this.#rows - 1 }, (_, row) =>
      this.object.localToWorld(new Vector3(0, -((row + 1.5) * ROW) / PIXELS_PER_METRE, 0)),
    );
  }

  #draw({ title, items }: MenuPage): void {
    this.#rows = items.length + 1;
    const height = this.#rows * ROW;
    this.#plate.draw(height, (context) => {
      context.fillStyle = '#0d141b';
      context.beginPath();
      context.roundRect(0, 0, WIDTH, height, 32);
      context.fill();
      context.textBaseline = 'middle';
      context.textAlign = 'left';
      context.font = `700 ${SIZE}px system-ui, sans-serif`;
      context.fillStyle = '#9fb2c1';
      context.fillText(title, EDGE, ROW / 2);
      for (const [index, { text, choice, tone }] of items.entries()) {
        const top = (index + 1) * ROW;
        context.fillStyle = tone === 'bad' ? '#7a1a1f' : choice === null ? '#0d141b' : '#1b2833';
        context.beginPath();
        context.roundRect(12, top + 6, WIDTH - 24, ROW - 12, 16);
        context.fill();
        context.font = `${tone === undefined ? 500 : 700} ${SIZE}px system-ui, sans-serif`;
        context.fillStyle = tone === 'chosen' ? '#35c9b5' : choice === null ? '#9fb2c1' : '#ffffff';
        context.fillText(shortened(context, text), EDGE, top + ROW / 2 + 2);
      }
    });
  }
}

/** A robot's name has any length. */
function shortened(context: CanvasRenderingContext2D, text: string): string {
  const fits = (words: string) => context.measureText(words).width <= WIDTH - 2 * EDGE;
  if (fits(text)) return text;
  let length = text.length - 1;
  while (length > 0 && !fits(`${text.slice(0, length).trimEnd()}…`)) length--;
  return `${text.slice(0, length).trimEnd()}…`;
}
