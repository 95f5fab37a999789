/** A camera that fills the screen: its picture changes places with the cloud, which is then in the camera's panel. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { cameraWords } from '../../words/camera-words.ts';
import { elements } from './elements.ts';

/** The text at the top of the screen: which camera it is, and how old its picture. */
const label = document.createElement('p');

/** @param filling the camera that fills the screen */
export function showStagedCamera(
  filling: ReadonlySignal<CameraView | null>,
  sampledAtMs: ReadonlySignal<number>,
): void {
  const { stage, cameraStage } = elements;
  let shown: CameraView | null = null;
  effect(() => {
    const view = filling.value;
    if (view === shown) return;
    if (shown !== null) {
      stage.replaceWith(shown.canvas);
      document.body.prepend(stage);
    }
    cameraStage.replaceChildren(label);
    shown = view;
    cameraStage.hidden = view === null;
    if (view === null) return;
    // Its panel has it no longer if there is another session; then it is not staged either.
    view.canvas.replaceWith(stage);
    cameraStage.prepend(view.canvas);
  });
  effect(() => {
    void sampledAtMs.value;
    const view = filling.value;
    if (view === null) return;
    const { state, text, reason } = cameraWords(view);
    const words = `${view.camera.name} · ${reason ?? text}`;
    if (label.textContent !== words) label.textContent = words;
    cameraStage.dataset.state = state;
  });
}
