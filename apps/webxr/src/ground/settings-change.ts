/** Which changes of the settings count at once, and which need a new connection, and so the page to start anew. */
import type { StoredSettings } from './settings.ts';

/** Who the signaling service knows this page as, and which service that is. Everything else counts at once. */
const OF_CONNECTION = ['signaling', 'tokens', 'name'] as const satisfies (keyof StoredSettings)[];

export function needsReload(before: StoredSettings, after: StoredSettings): boolean {
  return OF_CONNECTION.some((name) => textOf(before[name]) !== textOf(after[name]));
}

/** Nothing, an empty text and an empty token are the same. */
function textOf(value: StoredSettings[(typeof OF_CONNECTION)[number]]): string {
  if (typeof value === 'string' || value === undefined) return (value ?? '').trim();
  return JSON.stringify([...value].filter(([, token]) => token !== '').sort());
}
