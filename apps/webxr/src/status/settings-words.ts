/** What the settings dialog says. */

/** Beside each slider. */
export const sliderWords: Readonly<Record<string, (value: number) => string>> = {
  pointScale: (scale) => `${scale.toFixed(2)} ×`,
  vignette: (share) => (share === 0 ? 'none' : `${Math.round(share * 100)} %`),
  resolution: (share) => `${Math.round(share * 100)} %`,
};

/** On the button that keeps the settings. */
export function saveWords(reloads: boolean): string {
  return reloads ? 'Save and reconnect' : 'Save';
}
