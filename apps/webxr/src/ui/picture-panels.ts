/** The panels with the cameras' pictures: name, age, and a button that shows or hides the picture. */
import { computed, effect } from '@preact/signals-core';
import type { CameraView } from '../pictures/camera-pictures.ts';
import type { PageState } from '../state/page-state.ts';
import { elements } from './elements.ts';

interface Panel {
  view: CameraView;
  figure: HTMLElement;
  age: HTMLElement;
  button: HTMLButtonElement;
}

export function showPicturePanels({ pictures, cameras }: PageState): void {
  const panels = computed(() =>
    pictures.views.value.map((view) => panelOf(view, () => cameras.toggle(view.camera.index))),
  );
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
    for (const panel of panels.value) showAge(panel);
  });
}

function showAge({ view, figure, age }: Panel): void {
  const shown = view.camera.on.value;
  const ageMs = view.ageMs.value;
  const stale = view.stale.value;
  const words = !shown ? 'hidden' : ageMs === null ? 'waiting' : ageWords(ageMs, stale);
  if (age.textContent !== words) age.textContent = words;
  figure.dataset.stale = String(shown && stale);
  view.canvas.hidden = !shown || ageMs === null;
}

function panelOf(view: CameraView, onToggle: () => void): Panel {
  const figure = document.createElement('figure');
  figure.dataset.camera = String(view.camera.index);
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
    onToggle();
  });
  caption.append(name, age, button);
  figure.append(caption, view.canvas);
  return { view, figure, age, button };
}

function ageWords(ageMs: number, stale: boolean): string {
  return stale ? `stale, ${(ageMs / 1000).toFixed(1)} s` : `${Math.round(ageMs / 10) * 10} ms`;
}
