import { signal } from '@preact/signals-core';
import { type HeadsetSettings, parseHeadset } from './headset-settings.ts';
import type { PageOrigin, Settings, StoredSettings } from './settings.ts';
import { type MapTiles, mapTilesOf } from './telemetry/map-tiles.ts';

/**
 * The page's settings, of which some change while the page runs: a reader has each as it is now, and an effect that reads one
 * runs again.
 */
export interface LiveSettings extends Settings {
  /** Takes over what was saved, as far as it counts without a new connection. */
  apply(stored: StoredSettings): void;
}

/** @param settings as the page began with them */
export function liveSettings(settings: Settings, page: PageOrigin): LiveSettings {
  const synchronised = signal(settings.synchronised);
  const cues = signal(settings.cues);
  const clips = signal(settings.clips);
  const mapTiles = signal<MapTiles | null>(settings.mapTiles);
  const headset = signal(settings.headset);
  return {
    ...settings,
    headset: headsetView(() => headset.value),
    get synchronised() {
      return synchronised.value;
    },
    get cues() {
      return cues.value;
    },
    get clips() {
      return clips.value;
    },
    get mapTiles() {
      return mapTiles.value;
    },
    apply(stored) {
      synchronised.value = stored.synchronised ?? true;
      cues.value = stored.cues ?? true;
      clips.value = stored.clips ?? false;
      headset.value = parseHeadset(stored.headset);
      const tiles = mapTilesOf(stored.mapTiles, stored.mapAttribution, page);
      // The same tiles are not fetched anew.
      if (JSON.stringify(tiles) !== JSON.stringify(mapTiles.peek())) mapTiles.value = tiles;
    },
  };
}

/** One object for all of the page's life, whose properties are those of the newest settings. */
function headsetView(newest: () => HeadsetSettings): HeadsetSettings {
  const names = Object.keys(newest()) as (keyof HeadsetSettings)[];
  const properties = names.map((name) => [name, { enumerable: true, get: () => newest()[name] }] as const);
  return Object.defineProperties({}, Object.fromEntries(properties)) as HeadsetSettings;
}
