/** Which of the cameras is shown enlarged. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { CameraView } from '../ground/pictures/camera-view.ts';

export class Enlarged {
  readonly #views: ReadonlySignal<readonly CameraView[]>;
  readonly #chosen = signal<CameraView | null>(null);

  /** `null` if none is, also when the chosen camera has been switched off or is another robot's. */
  readonly view: ReadonlySignal<CameraView | null> = computed(() => {
    const chosen = this.#chosen.value;
    return chosen !== null && this.#shown.value.includes(chosen) ? chosen : null;
  });
  readonly #shown = computed(() => this.#views.value.filter(({ camera }) => camera.on.value));

  constructor(views: ReadonlySignal<readonly CameraView[]>) {
    this.#views = views;
  }

  /** Enlarges this camera, or shows it at its usual size again. */
  toggle(view: CameraView): void {
    this.#chosen.value = this.view.peek() === view ? null : view;
  }

  /** Enlarges the next of the cameras that are shown; after the last one, none. */
  next(): void {
    const view = this.view.peek();
    const shown = this.#shown.peek();
    this.#chosen.value = shown[view === null ? 0 : shown.indexOf(view) + 1] ?? null;
  }
}
