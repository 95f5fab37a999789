/** The panels with the cameras' pictures and videos: name, age, and a button that shows or hides the camera. */
import { computed, effect } from '@preact/signals-core';
import type { CameraView } from '../pictures/camera-view.ts';
import type { PageState } from '../state/page-state.ts';
import { elements } from './elements.ts';

interface Panel {
  view: CameraView;
  figure: HTMLElement;
  age: HTMLElement;
  fault: HTMLElement;
  button: HTMLButtonElement;
}

export function showPicturePanels({ views, enlarged, sampledAtMs }: PageState): void {
  const panels = computed(() => views.value.map((view) => panelOf(view, () => enlarged.toggle(view))));
  effect(() => {
    elements.pictures.replaceChildren(...panels.value.map(({ figure }) => figure));
    elements.pictures.hidden = panels.value.length === 0;
  });
  effect(() => {
    for (const { view, button } of panels.value) {
      const shown = view.camera.on.value;
      button.textContent = shown ? '–' : '+';
      button.ariaLabel = `${shown ? 'Hide' : 'Show'} ${view.camera.name}`;
    }
  });
  effect(() => {
    for (const { view, figure } of panels.value)
      figure.dataset.enlarged = String(enlarged.view.value === view);
  });
  effect(() => {
    // The age of a video changes with each of its frames: faster than anybody reads.
    void sampledAtMs.value;
    for (const panel of panels.value) showAge(panel);
  });
}

function showAge({ view, figure, age, fault }: Panel): void {
  const shown = view.camera.on.value;
  const ageMs = view.ageMs.peek();
  const stale = view.stale.value;
  const wrong = view.fault.value;
  const words = !shown ? 'hidden' : ageMs === null ? 'waiting' : ageWords(ageMs, stale);
  if (age.textContent !== words) age.textContent = words;
  if (fault.textContent !== wrong) fault.textContent = wrong;
  fault.hidden = !shown || wrong === null;
  figure.dataset.stale = String(shown && (stale || wrong !== null));
  view.canvas.hidden = !shown || ageMs === null;
}

function panelOf(view: CameraView, onEnlarge: () => void): Panel {
  const figure = document.createElement('figure');
  figure.dataset[view.kind === 'video' ? 'video' : 'camera'] = String(view.camera.index);
  const caption = document.createElement('figcaption');
  const name = document.createElement('span');
  name.className = 'name';
  name.textContent = view.camera.name;
  name.title = view.camera.name;
  const age = document.createElement('span');
  age.className = 'age';
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.addEventListener('click', () => {
    // A button that kept the focus would take the space bar, which is the drive grip.
    button.blur();
    view.toggle();
  });
  const fault = document.createElement('p');
  fault.className = 'fault';
  view.canvas.title = 'Enlarge or reduce (E)';
  view.canvas.onclick = onEnlarge;
  caption.append(name, age, button);
  figure.append(caption, fault, view.canvas);
  return { view, figure, age, fault, button };
}

function ageWords(ageMs: number, stale: boolean): string {
  return stale ? `stale, ${(ageMs / 1000).toFixed(1)} s` : `${Math.round(ageMs / 10) * 10} ms`;
}
