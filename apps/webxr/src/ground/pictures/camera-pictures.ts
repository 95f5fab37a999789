/** The cameras that send single pictures. */
import type { Picture } from '@farpoint/operator';
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { Switches } from '../switches.ts';
import { DrawnCamera } from './camera-view.ts';

const NO_FAULT = signal(null);

export class CameraPictures {
  /** One view per camera, in the robot's order. */
  readonly views: ReadonlySignal<readonly DrawnCamera[]>;

  /** @param atMs the time for which ages are computed: page's clock, ms */
  constructor(cameras: Switches, atMs: ReadonlySignal<number>, newCanvas: () => HTMLCanvasElement) {
    this.views = computed(() =>
      cameras.all.value.map((camera) => {
        const toggle = () => cameras.toggle(camera.index);
        return new DrawnCamera({
          kind: 'picture',
          camera,
          canvas: newCanvas(),
          fault: NO_FAULT,
          atMs,
          toggle,
        });
      }),
    );
  }

  /** Draws the picture and closes its bitmap. @param nowMs page's clock */
  show({ camera, bitmap, takenAtMs }: Picture, nowMs: number): void {
    this.views.peek()[camera]?.draw(bitmap, bitmap.width, bitmap.height, takenAtMs, nowMs);
    bitmap.close();
  }

  /** Counts a file of this camera that could not be decoded. */
  onFault(camera: number, detail: string): void {
    const view = this.views.peek()[camera];
    if (view === undefined) return;
    view.failures++;
    if (view.failures === 1) console.warn(`a picture of ${view.camera.name} cannot be shown:`, detail);
  }
}
