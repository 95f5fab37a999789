/** The settings that come from the browser: the page's origin and its local storage. */
import { ownSignalingUrl, type PageOrigin, parseStored, type StoredSettings } from './settings.ts';

const KEY = 'farpoint.settings';

export function pageOrigin(): PageOrigin {
  const { protocol, hostname, host } = window.location;
  return { protocol, hostname, host, isDevServer: import.meta.env.DEV };
}

/** The settings stored in this browser. Empty if the page may not use local storage. */
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
    // Private browsing: without storage, settings last for this visit only, in the page's address.
  }
}
