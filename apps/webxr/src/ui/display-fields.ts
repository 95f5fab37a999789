/** The settings dialog's part for the page's own look. What is changed in it applies at once. */
import { effect, type Signal } from '@preact/signals-core';
import { type DisplaySettings, parseDisplay } from '../display/display-settings.ts';

const CHOICES = ['theme', 'motion'] as const;

/** @param form of the settings dialog */
export function initDisplayFields(form: HTMLFormElement, settings: Signal<DisplaySettings>): void {
  const field = (name: keyof DisplaySettings | 'textScaleShown') =>
    form.elements.namedItem(name) as HTMLInputElement | HTMLSelectElement | HTMLOutputElement;
  const button = (id: string) => form.querySelector<HTMLButtonElement>(`#${id}`)!;
  effect(() => {
    const { theme, motion, textScale, awake } = settings.value;
    field('theme').value = theme;
    field('motion').value = motion;
    field('textScale').value = String(textScale);
    field('textScaleShown').value = `${Math.round(textScale * 100)} %`;
    (field('awake') as HTMLInputElement).checked = awake;
  });
  const read = () => {
    const chosen = Object.fromEntries(CHOICES.map((name) => [name, field(name).value]));
    const textScale = Number(field('textScale').value);
    const { checked: awake } = field('awake') as HTMLInputElement;
    settings.value = parseDisplay(JSON.stringify({ ...chosen, textScale, awake }));
  };
  for (const name of [...CHOICES, 'textScale', 'awake'] as const)
    field(name).addEventListener('change', read);
  button('display-reset').addEventListener('click', () => {
    settings.value = parseDisplay(null);
  });
  initFullScreen(button('full-screen'));
}

function initFullScreen(button: HTMLButtonElement): void {
  button.hidden = !document.fullscreenEnabled;
  const show = () => {
    button.ariaPressed = String(document.fullscreenElement !== null);
  };
  document.addEventListener('fullscreenchange', show);
  button.addEventListener('click', () => {
    const isFull = document.fullscreenElement !== null;
    // The browser may refuse; then it says so itself, and the button stays as it was.
    (isFull ? document.exitFullscreen() : document.documentElement.requestFullscreen()).catch(() => {});
  });
}
