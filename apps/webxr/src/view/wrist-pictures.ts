/** The cameras' pictures in VR, stacked beside the wrist panel. */
import { signal } from '@preact/signals-core';
import { Group } from 'three';
import type { CameraView } from '../pictures/camera-view.ts';
import { PictureSheet } from './picture-sheet.ts';

const WIDTH_M = 0.2;
const GAP_M = 0.012;
/** More pictures would hide the way ahead. */
const MOST_SHOWN = 3;

export class WristPictures {
  readonly object = new Group();
  readonly #sheets = signal<readonly PictureSheet[]>([]);

  get sheets(): readonly PictureSheet[] {
    return this.#sheets.peek();
  }

  /** Sets the cameras, and which of them are shown. */
  setViews(views: readonly CameraView[]): void {
    for (const sheet of this.#sheets.peek()) sheet.dispose();
    this.#sheets.value = views.slice(0, MOST_SHOWN).map((view) => {
      const sheet = new PictureSheet(view);
      this.object.add(sheet.mesh);
      return sheet;
    });
  }

  /** Uploads new pictures to the GPU. Call this within an effect, in VR only. */
  update(): void {
    let top = 0;
    for (const sheet of this.#sheets.value) {
      const tall = sheet.update(WIDTH_M);
      if (tall === 0) continue;
      sheet.mesh.position.set(0, top + tall / 2, 0);
      top += tall + GAP_M;
    }
  }
}
