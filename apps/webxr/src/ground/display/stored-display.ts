/** The page's look that this browser keeps, and what its system wishes. */
import { computed, effect, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';
import { type DisplaySettings, parseDisplay, type ShownDisplay, shownDisplay } from './display-settings.ts';
import { readPalette } from './palette.ts';

const KEY = 'farpoint.display';

/** The settings that the operator has chosen. They are kept once {@link applyDisplay} has been called. */
export const displaySettings: Signal<DisplaySettings> = signal(load());

const light = matching('(prefers-color-scheme: light)');
const moreContrast = matching('(prefers-contrast: more)');
const reducedMotion = matching('(prefers-reduced-motion: reduce)');

const shown: ReadonlySignal<ShownDisplay> = computed(() =>
  shownDisplay(displaySettings.value, {
    light: light.value,
    moreContrast: moreContrast.value,
    reducedMotion: reducedMotion.value,
  }),
);

/** From now on, the page looks as is chosen. */
export function applyDisplay(): void {
  const root = document.documentElement;
  effect(() => {
    const { theme, motion, textScale } = shown.value;
    root.dataset.theme = theme;
    root.dataset.motion = motion;
    root.style.setProperty('--text-scale', String(textScale));
    const style = getComputedStyle(root);
    readPalette(style);
    // The browser's own bars.
    document
      .querySelector('meta[name="theme-color"]')
      ?.setAttribute('content', style.getPropertyValue('--ground').trim());
  });
  effect(() => {
    try {
      localStorage.setItem(KEY, JSON.stringify(displaySettings.value));
    } catch {
      // Private browsing: the choice lasts for this visit only.
    }
  });
}

function load(): DisplaySettings {
  try {
    return parseDisplay(localStorage.getItem(KEY));
  } catch {
    return parseDisplay(null);
  }
}

function matching(query: string): ReadonlySignal<boolean> {
  const list = window.matchMedia(query);
  const matches = signal(list.matches);
  list.addEventListener('change', () => {
    matches.value = list.matches;
  });
  return matches;
}
