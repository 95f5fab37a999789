/** Which changes of the settings show at once, and which need the page to start anew. */
import { DEFAULT_HEADSET } from './headset/headset-settings.ts';
import type { StoredSettings } from './settings.ts';

/** They count at once. */
const LIVE: ReadonlySet<keyof StoredSettings> = new Set([
  ...(['pointScale', 'synchronised', 'cues', 'clips', 'headset'] as const),
]);

/** Whether the page must start anew, and connect again, for what was changed to count. */
export function needsReload(before: StoredSettings, after: StoredSettings): boolean {
  // The hand that drives is not changed under a hand that may be driving.
  const handOf = ({ headset }: StoredSettings) => headset?.driveHand ?? DEFAULT_HEADSET.driveHand;
  return textOf(before) !== textOf(after) || handOf(before) !== handOf(after);
}

function textOf(settings: StoredSettings): string {
  const parts = Object.entries(settings).filter(([name]) => !LIVE.has(name as keyof StoredSettings));
  // A token that is empty is none.
  const shown = (value: unknown) =>
    value instanceof Map ? [...value].filter(([, token]) => token !== '') : (value ?? '');
  return JSON.stringify(parts.map(([name, value]) => [name, shown(value)]).sort());
}
