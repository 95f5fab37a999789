/** The settings dialog's part for the page's own look. Its changes show at once; the language, once the page is loaded again. */
import { effect, type Signal } from '@preact/signals-core';
import { type DisplaySettings, displayOf } from '../../ground/display/display-settings.ts';
import { elements } from './elements.ts';

const CHOICES = ['language', 'theme', 'motion'] as const;

type Field = HTMLInputElement | HTMLSelectElement;

/** @param form of the settings dialog */
export function initDisplayFields(form: HTMLFormElement, settings: Signal<DisplaySettings>): void {
  const field = (name: keyof DisplaySettings) => form.elements.namedItem(name) as Field;
  const awake = field('awake') as HTMLInputElement;
  effect(() => {
    const chosen = settings.value;
    for (const name of CHOICES) field(name).value = chosen[name];
    field('textScale').value = String(chosen.textScale);
    awake.checked = chosen.awake;
  });
  const read = () => {
    settings.value = displayOf({
      language: field('language').value,
      theme: field('theme').value,
      motion: field('motion').value,
      textScale: Number(field('textScale').value),
      awake: awake.checked,
    });
  };
  // The slider moves below the finger when its text grows: its size follows when it is let go.
  for (const name of [...CHOICES, 'textScale', 'awake'] as const)
    field(name).addEventListener('change', read);
  initFullScreen();
}

function initFullScreen(): void {
  const { fullScreen } = elements;
  // Browsers on small telephones have no full screen.
  fullScreen.hidden = !document.fullscreenEnabled;
  const show = () => {
    fullScreen.ariaPressed = String(document.fullscreenElement !== null);
  };
  document.addEventListener('fullscreenchange', show);
  fullScreen.addEventListener('click', () => {
    const isFull = document.fullscreenElement !== null;
    const changed = isFull ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    // A browser that refuses says so itself, and the button stays as it was.
    changed.catch(() => {});
  });
}
