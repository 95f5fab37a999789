/** Which camera has changed places with the cloud: it fills the screen, and the cloud is in its panel. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { CameraView } from '../ground/pictures/camera-view.ts';

export class Staged {
  readonly #chosen = signal<CameraView | null>(null);
  readonly #shown: ReadonlySignal<readonly CameraView[]>;

  /** `null` if none has, also when the chosen camera has been switched off, or there is no session. */
  readonly view: ReadonlySignal<CameraView | null>;

  /** @param live whether there is a session */
  constructor(views: ReadonlySignal<readonly CameraView[]>, live: ReadonlySignal<boolean>) {
    this.#shown = computed(() => views.value.filter(({ camera }) => camera.on.value));
    this.view = computed(() => {
      const chosen = this.#chosen.value;
      return chosen !== null && live.value && this.#shown.value.includes(chosen) ? chosen : null;
    });
  }

  /** Lets this camera fill the screen, or the cloud again. */
  toggle(view: CameraView): void {
    this.#chosen.value = this.view.peek() === view ? null : view;
  }

  /** The same for the camera that is enlarged, or else the first that is shown. */
  swap(enlarged: CameraView | null): void {
    const view = this.view.peek() ?? enlarged ?? this.#shown.peek()[0];
    if (view !== undefined) this.toggle(view);
  }
}
