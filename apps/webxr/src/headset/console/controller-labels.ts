/** The labels of one hand's controller, each with a line to its control, turned towards the eyes. */
import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Object3D,
  Quaternion,
  Vector3,
} from 'three';
import { CONTROLS, type Control, type ControlWords } from '../../status/controller-label-words.ts';
import { drawOverWorld, PANEL_ORDER } from '../../view/panel-order.ts';
import { TextPlate } from '../../view/text-plate.ts';
import { controllerFigure } from './controller-figure.ts';
import { controlPlace, showsLabels } from './controller-shape.ts';
import { Fade } from './fade.ts';

const PIXELS_PER_METRE = 2800;
const SIZE = 34;
const HEIGHT = 48;
const WIDTH = 600;
const EDGE = 12;
const FONT = `600 ${SIZE}px system-ui, sans-serif`;
/** Beside the controller, and from one label to the next, m. */
const BESIDE_M = 0.07;
const APART_M = 0.021;
/** Of the first label above the controller, m. */
const ABOVE_M = 0.07;

interface Label {
  readonly control: Control;
  readonly place: Vector3;
  readonly plate: TextPlate;
  text: string | null;
}

export class ControllerLabels {
  /** A child of the rig. */
  readonly object = new Group();
  readonly hand: 'left' | 'right';
  readonly #figure: Group;
  readonly #labels: readonly Label[];
  readonly #lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  readonly #ends: BufferAttribute;
  readonly #fade = new Fade();
  readonly #turn = new Quaternion();
  readonly #at = new Vector3();
  readonly #ahead = new Vector3();
  /** Towards the outside, in the view. */
  readonly #outwards: 1 | -1;
  /** The space of the controller's grip; `null` while this hand holds none. */
  #grip: Object3D | null = null;

  constructor(hand: 'left' | 'right') {
    this.hand = hand;
    this.#outwards = hand === 'right' ? 1 : -1;
    this.#figure = controllerFigure(hand);
    this.#labels = CONTROLS.map((control) => {
      const { x, y, z } = controlPlace(control, hand);
      const size = { width: WIDTH, height: HEIGHT, pixelsPerMetre: PIXELS_PER_METRE };
      const plate = new TextPlate(size, PANEL_ORDER.label);
      this.object.add(plate.mesh);
      return { control, place: new Vector3(x, y, z), plate, text: null };
    });
    this.#ends = new BufferAttribute(new Float32Array(CONTROLS.length * 6), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry().setAttribute('position', this.#ends);
    this.#lines = new LineSegments(geometry, new LineBasicMaterial({ color: 0xe6edf3 }));
    this.#lines.frustumCulled = false;
    drawOverWorld(this.#lines, PANEL_ORDER.label);
    this.object.add(this.#lines);
    this.object.visible = false;
  }

  /** The labels that are in view, for tests. */
  get shown(): { control: Control; text: string }[] {
    if (!this.object.visible) return [];
    return this.#labels.flatMap(({ control, text }) => (text === null ? [] : [{ control, text }]));
  }

  /** Where the controller is; `null` if this hand holds none. */
  set grip(grip: Object3D | null) {
    this.#grip = grip;
    if (grip === null) this.#figure.removeFromParent();
    else grip.add(this.#figure);
  }

  /** Redraws only what has changed. */
  say(words: ControlWords): void {
    for (const label of this.#labels) {
      const text = words[label.control];
      if (text === label.text) continue;
      label.text = text;
      if (text !== null) this.#draw(label.plate, text, label.control);
    }
  }

  /**
   * Call this before each display frame in VR. Allocates nothing.
   *
   * @param head the operator's head, in the same space @param sinceMs since the headset was put on
   */
  update(head: Object3D, sinceMs: number, elapsedMs: number): void {
    const grip = this.#grip;
    const isTracked = grip?.visible === true;
    this.#fade.shown = isTracked && showsLabels(this.#cosine(head, grip), sinceMs);
    const share = this.#fade.update(elapsedMs);
    this.object.visible = isTracked && share > 0;
    if (!isTracked || share === 0) return;
    this.object.position.copy(grip.position);
    this.object.quaternion.copy(head.quaternion);
    this.#turn.copy(head.quaternion).invert().multiply(grip.quaternion);
    this.#lines.material.opacity = share * 0.7;
    let row = 0;
    for (let index = 0; index < this.#labels.length; index++) {
      const { text, plate, place } = this.#labels[index] as Label;
      plate.opacity = text === null ? 0 : share;
      const at = this.#at.copy(place).applyQuaternion(this.#turn);
      this.#ends.setXYZ(2 * index, at.x, at.y, at.z);
      if (text !== null) {
        const x = this.#outwards * BESIDE_M;
        const y = ABOVE_M - row * APART_M;
        plate.mesh.position.set(x + (this.#outwards * WIDTH) / 2 / PIXELS_PER_METRE, y, 0);
        at.set(x, y - HEIGHT / 2 / PIXELS_PER_METRE, 0);
        row++;
      }
      // Of a control without a label, the line has no length.
      this.#ends.setXYZ(2 * index + 1, at.x, at.y, at.z);
    }
    this.#ends.needsUpdate = true;
  }

  #cosine(head: Object3D, grip: Object3D | null): number {
    if (grip === null) return -1;
    this.#ahead.set(0, 0, -1).applyQuaternion(head.quaternion);
    return this.#at.copy(grip.position).sub(head.position).normalize().dot(this.#ahead);
  }

  #draw(plate: TextPlate, text: string, control: Control): void {
    const width = Math.min(plate.measure(text, FONT) + 2 * EDGE, WIDTH);
    const left = this.hand === 'right' ? 0 : WIDTH - width;
    plate.draw(HEIGHT, (context) => {
      context.fillStyle = control === 'upper' ? '#5c1418' : '#0d141b';
      context.beginPath();
      context.roundRect(left, 0, width, HEIGHT, 10);
      context.fill();
      context.font = FONT;
      context.textBaseline = 'middle';
      context.textAlign = 'left';
      context.fillStyle = '#ffffff';
      context.fillText(text, left + EDGE, HEIGHT / 2 + 2, WIDTH - 2 * EDGE);
    });
  }
}
