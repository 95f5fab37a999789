import { signal } from '@preact/signals-core';
import { type HeadsetSettings, parseHeadset } from './headset/headset-settings.ts';
import type { Settings, StoredSettings } from './settings.ts';

/**
 * The page's settings; those of how everything looks, sounds and turns change while it runs. Whoever reads one at its use
 * has it as it is now, and an effect that reads one runs again.
 */
export interface LiveSettings extends Settings {
  /** Takes over what was saved, as far as it counts at once. */
  apply(stored: StoredSettings): void;
}

/** @param settings as the page began with them */
export function liveSettings(settings: Settings): LiveSettings {
  const synchronised = signal(settings.synchronised);
  const cues = signal(settings.cues);
  const clips = signal(settings.clips);
  const headset = signal(settings.headset);
  // Whoever gets them keeps them.
  const view = Object.defineProperties(
    {},
    Object.fromEntries(
      Object.keys(settings.headset).map((name) => [
        name,
        { enumerable: true, get: () => headset.value[name as keyof HeadsetSettings] },
      ]),
    ),
  ) as HeadsetSettings;
  return {
    ...settings,
    headset: view,
    get synchronised() {
      return synchronised.value;
    },
    get cues() {
      return cues.value;
    },
    get clips() {
      return clips.value;
    },
    apply(stored) {
      synchronised.value = stored.synchronised ?? true;
      cues.value = stored.cues ?? true;
      clips.value = stored.clips ?? false;
      headset.value = parseHeadset(stored.headset);
    },
  };
}
