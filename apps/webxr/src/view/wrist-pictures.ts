/** The cameras' pictures in VR, stacked beside the wrist panel. */
import { signal } from '@preact/signals-core';
import { CanvasTexture, Group, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import type { CameraView } from '../pictures/camera-view.ts';

const WIDTH_M = 0.2;
const GAP_M = 0.012;
/** More pictures would hide the way ahead. */
const MOST_SHOWN = 3;
const STALE_COLOUR = 0x555555;
const FRESH_COLOUR = 0xffffff;

interface Sheet {
  view: CameraView;
  mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  texture: CanvasTexture;
  width: number;
  height: number;
  /** Number of the picture that is on the GPU. */
  picture: number;
}

export class WristPictures {
  readonly object = new Group();
  readonly #sheets = signal<readonly Sheet[]>([]);

  /** Sets the cameras, and which of them are shown. */
  setViews(views: readonly CameraView[]): void {
    for (const { mesh, texture } of this.#sheets.peek()) {
      this.object.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      texture.dispose();
    }
    this.#sheets.value = views.slice(0, MOST_SHOWN).map((view) => {
      const texture = new CanvasTexture(view.canvas);
      texture.colorSpace = SRGBColorSpace;
      const mesh = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({ map: texture }));
      mesh.visible = false;
      this.object.add(mesh);
      return { view, mesh, texture, width: 0, height: 0, picture: 0 };
    });
  }

  /** Uploads new pictures to the GPU. Call this within an effect, in VR only. */
  update(): void {
    let top = 0;
    for (const sheet of this.#sheets.value) {
      const { view, mesh, texture } = sheet;
      const newest = view.newest.value;
      mesh.visible = newest !== null;
      if (newest === null) continue;
      const { width, height } = view.canvas;
      if (width !== sheet.width || height !== sheet.height) {
        // A texture cannot change its size.
        texture.dispose();
        Object.assign(sheet, { width, height });
      }
      if (sheet.picture !== newest.number) texture.needsUpdate = true;
      sheet.picture = newest.number;
      const tall = (WIDTH_M * height) / width;
      mesh.scale.set(WIDTH_M, tall, 1);
      mesh.position.set(0, top + tall / 2, 0);
      mesh.material.color.set(view.stale.value || view.fault.value !== null ? STALE_COLOUR : FRESH_COLOUR);
      top += tall + GAP_M;
    }
  }
}
