/** Shows the cameras' pictures in VR: beside the wrist panel, and the one that is enlarged or fills the view. */
import { effect, type ReadonlySignal, signal } from '@preact/signals-core';
import {
  CanvasTexture,
  Group,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  PlaneGeometry,
  SRGBColorSpace,
} from 'three';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import type { PageState } from '../../state/page-state.ts';
import { cameraWords } from '../../words/camera-words.ts';
import { PictureSheet } from './picture-sheet.ts';
import type { Stage } from './stage.ts';
import type { WristPanel } from './wrist-panel.ts';

/** A caption's size, pixels. */
const WIDTH = 512;
const HEIGHT = 56;

/** The line below a camera's picture in VR: its name, and its state unless it is live. */
class SheetCaption {
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #view: CameraView;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;
  #shown = '';

  constructor(view: CameraView) {
    this.#view = view;
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: WIDTH, height: HEIGHT });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    this.mesh = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({ map: this.#texture }));
  }

  /**
   * Draws anew only what has changed: of a live camera, nothing. Call it a few times a second.
   *
   * @returns its height, metres
   */
  update(widthM: number): number {
    const { state, text, reason } = cameraWords(this.#view);
    const words = state === 'live' ? '' : ` · ${reason ?? text}`;
    const line = this.#view.camera.name + words;
    if (line !== this.#shown) this.#draw(line, words === '' ? '#9fb2c1' : '#f0b429');
    const tallM = (widthM * HEIGHT) / WIDTH;
    this.mesh.scale.set(widthM, tallM, 1);
    return tallM;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.#texture.dispose();
  }

  #draw(line: string, colour: string): void {
    this.#shown = line;
    const context = this.#context;
    context.fillStyle = '#0d141b';
    context.fillRect(0, 0, WIDTH, HEIGHT);
    context.font = '32px system-ui, sans-serif';
    context.textBaseline = 'middle';
    context.fillStyle = colour;
    context.fillText(line, 16, HEIGHT / 2, WIDTH - 32);
    this.#texture.needsUpdate = true;
  }
}

/** Metres, from the eyes at rest: right, up, back. Turned towards the eyes. */
const ENLARGED = { widthM: 0.7, at: [0.52, -0.08, -1.25], turn: -0.4 } as const;
const FILLING = { widthM: 2.6, at: [0, 0.15, -2], turn: 0 } as const;

/**
 * A camera's picture that hangs in front of the operator in VR, at the robot: enlarged, beside the way ahead; or in place
 * of the cloud, as a screen that fills the view. The cloud stays around it.
 */
class FrontPicture {
  readonly object = new Group();
  readonly #sheet = signal<PictureSheet | null>(null);
  readonly #fills = signal(false);
  #caption: SheetCaption | null = null;

  get sheets(): readonly PictureSheet[] {
    const sheet = this.#sheet.peek();
    return sheet === null ? [] : [sheet];
  }

  /** @param fills whether it fills the view */
  set(view: CameraView | null, fills: boolean): void {
    this.#fills.value = fills;
    const before = this.#sheet.peek();
    if (before?.view === view) return;
    before?.dispose();
    const sheet = view === null ? null : new PictureSheet(view);
    this.#caption?.dispose();
    this.#caption = view === null ? null : new SheetCaption(view);
    if (sheet !== null) this.object.add(sheet.mesh);
    if (this.#caption !== null) this.object.add(this.#caption.mesh);
    this.#sheet.value = sheet;
  }

  /** Uploads a new picture to the GPU. Call this within an effect, in VR only. */
  update(): void {
    const { widthM, at, turn } = this.#fills.value ? FILLING : ENLARGED;
    const tall = this.#sheet.value?.update(widthM) ?? 0;
    const caption = this.#caption?.mesh;
    caption?.position.set(0, -(tall + caption.scale.y) / 2, 0);
    const [x, y, z] = at;
    this.object.position.set(x, y, z);
    this.object.rotation.set(0, turn, 0);
  }

  /** Brings the caption up to date. Call this within an effect, in VR only. @param atMs changes a few times a second */
  caption(atMs: ReadonlySignal<number>): void {
    void atMs.value;
    void this.#sheet.value;
    this.#caption?.update((this.#fills.value ? FILLING : ENLARGED).widthM);
  }
}

/** A picture's width on the wrist, and the gap to the next, m. Chosen by eye: about as wide as the panel. */
const WIDTH_M = 0.2;
const GAP_M = 0.012;
/** More pictures would hide the way ahead. */
const MOST_SHOWN = 3;

interface Shown {
  readonly sheet: PictureSheet;
  readonly caption: SheetCaption;
}

/** The cameras' pictures in VR, stacked beside the wrist panel. */
class WristPictures {
  readonly object = new Group();
  readonly #shown = signal<readonly Shown[]>([]);

  get sheets(): readonly PictureSheet[] {
    return this.#shown.peek().map(({ sheet }) => sheet);
  }

  /** Sets the cameras, and which of them are shown. */
  setViews(views: readonly CameraView[]): void {
    for (const { sheet, caption } of this.#shown.peek()) {
      sheet.dispose();
      caption.dispose();
    }
    this.#shown.value = views.slice(0, MOST_SHOWN).map((view) => {
      const [sheet, caption] = [new PictureSheet(view), new SheetCaption(view)];
      this.object.add(sheet.mesh, caption.mesh);
      return { sheet, caption };
    });
  }

  /** Uploads new pictures to the GPU. Call this within an effect, in VR only. */
  update(): void {
    let top = 0;
    for (const { sheet, caption } of this.#shown.value) {
      const captionTall = caption.mesh.scale.y;
      const tall = sheet.update(WIDTH_M);
      caption.mesh.position.set(0, top + captionTall / 2, 0);
      sheet.mesh.position.set(0, top + captionTall + tall / 2, 0);
      top += captionTall + tall + GAP_M;
    }
  }

  /** Brings the captions up to date. Call this within an effect, in VR only. @param atMs changes a few times a second */
  caption(atMs: ReadonlySignal<number>): void {
    void atMs.value;
    for (const { caption } of this.#shown.value) caption.update(WIDTH_M);
  }
}

export interface VrPicturesParts {
  readonly state: PageState;
  readonly panel: WristPanel;
  readonly stage: Pick<Stage, 'headset'>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
}

/** The pictures that can be chosen. */
export interface PicturesInVr {
  readonly targets: () => readonly Object3D[];
  /** Shows the chosen one larger. */
  readonly choose: (target: Object3D) => void;
}

export function showPicturesInVr({ state, panel, stage, active }: VrPicturesParts): PicturesInVr {
  const { views, enlarged, staged } = state;
  const wrist = new WristPictures();
  const front = new FrontPicture();
  panel.addBeside(wrist.object);
  stage.headset.front.add(front.object);
  effect(() => {
    front.object.visible = active.value;
  });
  effect(() => {
    const inFront = staged.view.value ?? enlarged.view.value;
    wrist.setViews(views.value.filter((view) => view.camera.on.value && view !== inFront));
    front.set(inFront, inFront !== null && inFront === staged.view.value);
  });
  effect(() => {
    if (!active.value) return;
    wrist.caption(state.sampledAtMs);
    front.caption(state.sampledAtMs);
  });
  effect(() => {
    if (active.value) wrist.update();
  });
  effect(() => {
    if (active.value) front.update();
  });
  // Those at the wrist are nearer.
  const sheets = () => [...wrist.sheets, ...front.sheets];
  return {
    targets: () => sheets().map(({ mesh }) => mesh),
    choose: (target) => {
      const view = sheets().find(({ mesh }) => mesh === target)?.view;
      // The trigger releases the emergency stop while that is on.
      if (view !== undefined && !state.robot.estopLatched.peek()) state.nextSize(view);
    },
  };
}
