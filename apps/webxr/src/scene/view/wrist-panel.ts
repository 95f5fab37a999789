/**
 * The status in VR: a small panel on the wrist of the hand that does not drive, or low in front of the operator if there is
 * no such controller.
 */
import {
  CanvasTexture,
  Group,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  PlaneGeometry,
  SRGBColorSpace,
  type WebGLRenderer,
} from 'three';
import type { Hand } from '../../ground/headset-settings.ts';
import type { Tone } from '../../words/words.ts';
import { fitText } from '../fitted-text.ts';

/**
 * The picture's size, pixels, and its width and distance from the hand, m. Chosen by eye: a tablet's half,
 * with letters that can be read at arm's length.
 */
const WIDTH = 512;
const HEIGHT = 376;
const PANEL_M = 0.18;
const GAP_M = 0.02;
/** Of the panel's middle above a bare hand, m. Chosen by eye: what is below the panel is above the fingers. */
const ABOVE_HAND_M = 0.18;
/** From one line to the next, and from the edge to the text, pixels. */
const LINE = 44;
const EDGE = 24;
const MOST_LINES = 8;
const COLOURS: Record<Tone, string> = {
  good: '#35c9b5',
  neutral: '#9fb2c1',
  warning: '#f0b429',
  bad: '#ff5d5d',
};

export interface PanelLine {
  text: string;
  tone: Tone;
}

export class WristPanel {
  readonly #group = new Group();
  readonly #mesh: Mesh;
  #hand: Hand;
  readonly #front: Group;
  /** Of each hand whose controller is there. */
  readonly #grips = new Map<string, Group>();
  /** Of each hand that is bare. */
  readonly #bare = new Map<string, Group>();
  readonly #rig: Group;
  readonly #beside: Object3D[] = [];
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;
  #shown = '';
  #lines: readonly PanelLine[] = [];
  /** Progress shown by the bar at the bottom, in twentieths. */
  #progress = 0;

  /**
   * @param rig carries the tracked space
   * @param front carries what hangs before the operator
   * @param hand on whose wrist it is
   */
  constructor(renderer: WebGLRenderer, rig: Group, front: Group, hand: Hand) {
    this.#hand = hand;
    this.#front = front;
    this.#rig = rig;
    const canvas = document.createElement('canvas');
    canvas.width = WIDTH;
    canvas.height = HEIGHT;
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.#mesh = new Mesh(
      new PlaneGeometry(PANEL_M, (PANEL_M * HEIGHT) / WIDTH),
      new MeshBasicMaterial({ map: this.#texture, transparent: true, opacity: 0.92 }),
    );
    this.#group.add(this.#mesh);
    this.#group.visible = false;
    this.#place();
    for (const index of [0, 1]) {
      const grip = renderer.xr.getControllerGrip(index);
      rig.add(grip);
      grip.addEventListener('connected', ({ data }) => {
        (data.hand == null ? this.#grips : this.#bare).set(data.handedness, grip);
        this.#place();
      });
      grip.addEventListener('disconnected', () => {
        for (const grips of [this.#grips, this.#bare])
          for (const [side, own] of grips) if (own === grip) grips.delete(side);
        this.#place();
      });
    }
  }

  /** On whose wrist it is. */
  set hand(hand: Hand) {
    this.#hand = hand;
    this.#place();
  }

  /** Call this before each display frame in VR: above a bare hand the panel is turned to the eyes. @param head in the rig */
  update(head: Object3D): void {
    const bare = this.#bare.get(this.#hand);
    if (bare?.visible !== true) return;
    this.#group.position.copy(bare.position);
    this.#group.position.y += ABOVE_HAND_M;
    this.#group.quaternion.copy(head.quaternion);
  }

  /** On the wrist, above a bare hand, or before the operator while there is no such hand. */
  #place(): void {
    const grip = this.#grips.get(this.#hand);
    if (grip === undefined && this.#bare.has(this.#hand)) {
      this.#rig.add(this.#group);
      this.#group.scale.setScalar(1);
      this.#placeBeside();
      return;
    }
    (grip ?? this.#front).add(this.#group);
    // Chosen by eye: below the sign before the eyes, which hides nothing of it unless a text is long.
    if (grip === undefined) this.#group.position.set(0, -0.5, -0.62);
    else this.#group.position.set(0, 0.03, 0.06);
    this.#group.rotation.set(grip === undefined ? -0.68 : -1, 0, 0);
    this.#group.scale.setScalar(grip === undefined ? 1.6 : 1);
    this.#placeBeside();
  }

  #placeBeside(): void {
    const inwards = this.#hand === 'left' ? 1 : -1;
    for (const { position } of this.#beside)
      position.set(inwards * (PANEL_M + GAP_M), (-PANEL_M * HEIGHT) / WIDTH / 2, 0);
  }

  /** Adds an object beside the panel, on the inner side. It moves with the panel. */
  addBeside(object: Object3D): void {
    this.#beside.push(object);
    this.#group.add(object);
    this.#place();
  }

  /** Adds an object below the panel, which moves with it. Its origin is in the middle of its upper edge. */
  addBelow(object: Object3D): void {
    object.position.set(0, (-PANEL_M * HEIGHT) / WIDTH / 2 - GAP_M / 2, 0);
    this.#group.add(object);
  }

  /** The sheet itself. */
  get sheet(): Mesh {
    return this.#mesh;
  }

  /** What it shows; `null` while it is hidden. */
  get shown(): readonly PanelLine[] | null {
    return this.#group.visible ? this.#lines : null;
  }

  set visible(visible: boolean) {
    this.#group.visible = visible;
  }

  /** Redraws only what has changed. Call this at most a few times a second. */
  show(lines: readonly PanelLine[]): void {
    const key = lines.map((line) => line.tone + line.text).join('\n');
    if (key === this.#shown) return;
    this.#shown = key;
    this.#lines = lines;
    this.#draw();
  }

  /** Shows a progress bar at the bottom. @param share 0–1; at 0 there is no bar */
  showProgress(share: number): void {
    const progress = Math.round(share * 20);
    if (progress === this.#progress) return;
    this.#progress = progress;
    this.#draw();
  }

  #draw(): void {
    const context = this.#context;
    context.clearRect(0, 0, WIDTH, HEIGHT);
    context.fillStyle = '#0d141bee';
    context.beginPath();
    context.roundRect(0, 0, WIDTH, HEIGHT, 24);
    context.fill();
    context.textBaseline = 'top';
    for (const [index, line] of this.#lines.slice(0, MOST_LINES).entries()) {
      const weight = index === 0 ? 600 : 400;
      const measure = (text: string, size: number) => {
        context.font = `${weight} ${size}px system-ui, sans-serif`;
        return context.measureText(text).width;
      };
      const { rows, size } = fitText(line.text, index === 0 ? 36 : 30, WIDTH - 2 * EDGE, measure);
      measure('', size);
      context.fillStyle = COLOURS[line.tone];
      const top = 20 + index * LINE - (rows.length > 1 ? 2 : 0);
      for (const [row, text] of rows.entries()) context.fillText(text, EDGE, top + row * (size + 1));
    }
    if (this.#progress > 0) {
      context.fillStyle = COLOURS.bad;
      context.fillRect(24, HEIGHT - 10, ((WIDTH - 48) * this.#progress) / 20, 6);
    }
    this.#texture.needsUpdate = true;
  }
}
