/** The browser's part of the settings: where the page comes from, and what it keeps between visits. */
import { ownSignalingUrl, type PageOrigin, parseStored, type StoredSettings } from './settings.ts';

const KEY = 'farpoint.settings';

export function pageOrigin(): PageOrigin {
  const { protocol, hostname, host } = window.location;
  return { protocol, hostname, host, isDevServer: import.meta.env.DEV };
}

/** What this browser remembers; nothing where it may not. */
export function loadStored(): StoredSettings {
  try {
    return parseStored(localStorage.getItem(KEY), ownSignalingUrl(pageOrigin()));
  } catch {
    return {};
  }
}

export function store(settings: StoredSettings): void {
  try {
    const tokens = Object.fromEntries(settings.tokens ?? []);
    localStorage.setItem(KEY, JSON.stringify({ ...settings, tokens }));
  } catch {
    // Private browsing: the settings hold for this visit by the address only.
  }
}
