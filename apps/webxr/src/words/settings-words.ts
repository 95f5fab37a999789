/** What the settings dialog says. */
import { MOST_TEXT, type TileFault } from '../ground/telemetry/map-tiles.ts';
import { texts } from './language.ts';
import { fixed, percent } from './numbers.ts';

/** Beside each slider, by the name of its field. */
export const sliderWords: Readonly<Record<string, (value: number) => string>> = {
  pointScale: (scale) => `${fixed(scale, 2)} ×`,
  textScale: percent,
  vignette: (share) => (share === 0 ? texts().settings.noVignette : percent(share)),
  resolution: percent,
};

/** What the page does for the settings that have changed. */
export interface SaveEffect {
  /** It connects anew, and is loaded again for it. */
  readonly reconnects: boolean;
  /** It is loaded again for its language only. */
  readonly reloads: boolean;
}

/** On the button that keeps the settings. */
export function saveWords({ reconnects, reloads }: SaveEffect): string {
  const said = texts().settings;
  if (reconnects) return said.saveAndReconnect;
  return reloads ? said.saveAndReload : said.save;
}

/** What is wrong with the address of map tiles. */
export function tileFaultWords(fault: TileFault): string {
  return texts().settings.tileFaults[fault](MOST_TEXT);
}
