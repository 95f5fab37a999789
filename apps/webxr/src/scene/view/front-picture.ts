/**
 * A camera's picture that hangs in front of the operator in VR, at the robot: enlarged, beside the way ahead; or in place
 * of the cloud, as a screen that fills the view. The cloud stays around it.
 */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { Group } from 'three';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { PictureSheet } from './picture-sheet.ts';
import { SheetCaption } from './sheet-caption.ts';

/** Metres, from the eyes at rest: right, up, back. Turned towards the eyes. */
const ENLARGED = { widthM: 0.7, at: [0.52, -0.08, -1.25], turn: -0.4 } as const;
const FILLING = { widthM: 2.6, at: [0, 0.15, -2], turn: 0 } as const;

export class FrontPicture {
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
