/** What the settings dialog says. */

const percent = (share: number): string => `${Math.round(share * 100)} %`;

/** Beside each slider, by the name of its field. */
export const sliderWords: Readonly<Record<string, (value: number) => string>> = {
  pointScale: (scale) => `${scale.toFixed(2)} ×`,
  textScale: percent,
  vignette: (share) => (share === 0 ? 'none' : percent(share)),
  resolution: percent,
};

/** On the button that keeps the settings. @param reloads whether the page starts anew for them */
export function saveWords(reloads: boolean): string {
  return reloads ? 'Save and reconnect' : 'Save';
}
