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
import type { Hand } from '../../ground/headset-settings.ts';
import { CONTROLS, type Control, type ControlWords } from '../../words/controller-label-words.ts';
import { shortened } from '../fitted-text.ts';
import { Fade } from '../headset/fade.ts';
import { PLATE_ORDER, TextPlate } from '../headset/text-plate.ts';
import { ControllerFigure } from './controller-figure.ts';
import { controlPlace, type LabelSight, showsLabels } from './controller-shape.ts';
import { type Box, covers, ViewBox, WAY_AHEAD } from './view-box.ts';
import type { ViewFrame } from './view-frame.ts';

const PIXELS_PER_METRE = 2800;
/** Of the font, and a label's height and greatest width, pixels. Chosen: capitals of 1° at {@link NEAR_M}. */
const SIZE = 34;
const HEIGHT = 48;
const WIDTH = 460;
const EDGE = 12;
const FONT = `600 ${SIZE}px system-ui, sans-serif`;
/** Height of capital letters, share of a font's size: of the least that system fonts have. */
const CAPITAL = 0.7;
/** Labels of a hand that is farther from the eyes are larger: their letters keep their angle, m. */
const NEAR_M = 0.45;
/** Beside the controller; where the wrist carries the panel, beside that, m. Chosen by eye. */
const BESIDE_M = 0.06;
const BESIDE_PANEL_M = 0.125;
/** Of the first label above the controller, and from one to the next, m. Chosen by eye. */
const ABOVE_M = 0.07;
const APART_M = 0.021;

interface Label {
  readonly control: Control;
  readonly place: Vector3;
  readonly plate: TextPlate;
  text: string | null;
  /** Pixels. */
  width: number;
}

/** What {@link ControllerLabels.update} goes by. */
export interface LabelView {
  /** The operator's head, in the same space as the grip. */
  readonly head: Object3D;
  readonly frame: ViewFrame;
  /** What the labels must not cover. */
  readonly taken: readonly Box[];
  /** Since the headset was put on, ms. */
  sinceMs: number;
  elapsedMs: number;
  menuOpen: boolean;
  /** The operator sees the own hands. */
  passthrough: boolean;
}

export class ControllerLabels {
  /** A child of the rig. */
  readonly object = new Group();
  /** Where they are in the view. */
  readonly box = new ViewBox();
  readonly hand: Hand;
  readonly #figure: ControllerFigure;
  readonly #labels: readonly Label[];
  readonly #lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  readonly #ends = new BufferAttribute(new Float32Array(CONTROLS.length * 6), 3);
  readonly #fade = new Fade();
  readonly #turn = new Quaternion();
  readonly #at = new Vector3();
  readonly #ahead = new Vector3();
  readonly #sight: { -readonly [Key in keyof LabelSight]: LabelSight[Key] } = {
    cosine: -1,
    sinceMs: 0,
    menuOpen: false,
    inTheWay: false,
  };
  /** Towards the outside, in the view. */
  readonly #outwards: 1 | -1;
  #besideM = BESIDE_M;
  /** The space of the controller's grip; `null` while this hand holds none. */
  #grip: Object3D | null = null;

  constructor(hand: Hand) {
    this.hand = hand;
    this.#outwards = hand === 'right' ? 1 : -1;
    this.#figure = new ControllerFigure(hand);
    this.#labels = CONTROLS.map((control) => {
      const { x, y, z } = controlPlace(control, hand);
      const plate = new TextPlate({
        width: WIDTH,
        height: HEIGHT,
        pixelsPerMetre: PIXELS_PER_METRE,
        order: PLATE_ORDER.label,
      });
      this.object.add(plate.mesh);
      return { control, place: new Vector3(x, y, z), plate, text: null, width: 0 };
    });
    const geometry = new BufferGeometry().setAttribute('position', this.#ends.setUsage(DynamicDrawUsage));
    const material = new LineBasicMaterial({ color: 0xe6edf3, transparent: true, depthTest: false });
    this.#lines = new LineSegments(geometry, material);
    this.#lines.frustumCulled = false;
    this.#lines.renderOrder = PLATE_ORDER.label;
    this.object.add(this.#lines);
    this.object.visible = false;
  }

  /** The texts that are in view, for tests. */
  get shown(): string[] {
    return this.object.visible ? this.#labels.flatMap(({ text }) => text ?? []) : [];
  }

  /** Height of a capital letter, degrees. */
  get letterDegrees(): number {
    const high = (SIZE * CAPITAL * this.object.scale.x) / PIXELS_PER_METRE;
    return (Math.atan(high / this.#at.length()) * 180) / Math.PI;
  }

  /** Where the controller is; `null` if this hand holds none. */
  set grip(grip: Object3D | null) {
    this.#grip = grip;
    if (grip === null) this.#figure.object.removeFromParent();
    else grip.add(this.#figure.object);
  }

  /** Redraws only what has changed. @param carriesPanel whether the panel is on this wrist */
  say(words: ControlWords, carriesPanel: boolean): void {
    this.#besideM = carriesPanel ? BESIDE_PANEL_M : BESIDE_M;
    for (const label of this.#labels) {
      const text = words[label.control];
      if (text === label.text) continue;
      label.text = text;
      if (text !== null) draw(label, text);
    }
  }

  /** It is gone at once. */
  hide(): void {
    this.#fade.clear();
    this.#show(0, false);
  }

  /** Call this before each display frame in VR. Allocates nothing. */
  update(view: LabelView): void {
    const grip = this.#grip;
    if (grip?.visible !== true) {
      this.hide();
      return;
    }
    this.#place(grip, view.head);
    this.#measure(view.frame);
    const at = this.#at.copy(grip.position).sub(view.head.position);
    const sight = this.#sight;
    sight.cosine = this.#ahead.set(0, 0, -1).applyQuaternion(view.head.quaternion).dot(at) / at.length();
    sight.sinceMs = view.sinceMs;
    sight.menuOpen = view.menuOpen;
    sight.inTheWay = this.#isInTheWay(view.taken);
    this.#fade.shown = showsLabels(sight);
    this.#show(this.#fade.update(view.elapsedMs), !view.passthrough);
  }

  #isInTheWay(taken: readonly Box[]): boolean {
    if (covers(this.box, WAY_AHEAD)) return true;
    for (let index = 0; index < taken.length; index++) if (covers(this.box, taken[index] as Box)) return true;
    return false;
  }

  #measure(frame: ViewFrame): void {
    this.box.clear();
    for (let index = 0; index < this.#labels.length; index++) {
      const { text, plate } = this.#labels[index] as Label;
      if (text !== null) frame.add(plate.mesh, this.box);
    }
  }

  #show(share: number, withFigure: boolean): void {
    this.object.visible = share > 0;
    this.#figure.share = withFigure ? share : 0;
    this.#lines.material.opacity = share * 0.7;
    for (let index = 0; index < this.#labels.length; index++) {
      const { text, plate } = this.#labels[index] as Label;
      plate.opacity = text === null ? 0 : share;
    }
  }

  #place(grip: Object3D, head: Object3D): void {
    const { object } = this;
    object.position.copy(grip.position);
    object.quaternion.copy(head.quaternion);
    object.scale.setScalar(Math.max(1, grip.position.distanceTo(head.position) / NEAR_M));
    this.#turn.copy(head.quaternion).invert().multiply(grip.quaternion);
    let row = 0;
    for (let index = 0; index < this.#labels.length; index++) {
      const { text, plate, place, width } = this.#labels[index] as Label;
      const at = this.#at.copy(place).applyQuaternion(this.#turn).divideScalar(object.scale.x);
      this.#ends.setXYZ(2 * index, at.x, at.y, at.z);
      if (text !== null) {
        const x = this.#outwards * this.#besideM;
        const y = ABOVE_M - row * APART_M;
        plate.mesh.position.set(x + (this.#outwards * width) / 2 / PIXELS_PER_METRE, y, 0);
        at.set(x, y - HEIGHT / 2 / PIXELS_PER_METRE, 0);
        row++;
      }
      // Of a control without a label, the line has no length.
      this.#ends.setXYZ(2 * index + 1, at.x, at.y, at.z);
    }
    this.#ends.needsUpdate = true;
  }
}

function draw(label: Label, words: string): void {
  const { plate, control } = label;
  const widthOf = (text: string) => plate.measure(text, FONT) + 2 * EDGE;
  // A robot's name has any length.
  const text = shortened(words, (part) => widthOf(part) <= WIDTH);
  const width = widthOf(text);
  label.width = width;
  plate.draw(
    HEIGHT,
    (context) => {
      context.fillStyle = control === 'upper' ? '#5c1418' : '#0d141b';
      context.beginPath();
      context.roundRect(0, 0, width, HEIGHT, 10);
      context.fill();
      context.font = FONT;
      context.textBaseline = 'middle';
      context.textAlign = 'left';
      context.fillStyle = '#ffffff';
      context.fillText(text, EDGE, HEIGHT / 2 + 2);
    },
    width,
  );
}
