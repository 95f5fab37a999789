/** The cameras' pictures in VR, stacked beside the wrist panel. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { Group } from 'three';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { PictureSheet } from './picture-sheet.ts';
import { SheetCaption } from './sheet-caption.ts';

const WIDTH_M = 0.2;
const GAP_M = 0.012;
/** More pictures would hide the way ahead. */
const MOST_SHOWN = 3;

interface Shown {
  readonly sheet: PictureSheet;
  readonly caption: SheetCaption;
}

export class WristPictures {
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
