/** The settings that come from the browser: the page's origin and its local storage. */

import { ownSignalingUrl, type PageOrigin, parseStored, type StoredSettings } from './settings.ts';
import { parseTokens, type SignalingTokens, tokenOrigin, withToken } from './signaling-tokens.ts';

const KEY = 'farpoint.settings';
const VISIT_KEY = 'farpoint.visit-tokens';

export function pageOrigin(): PageOrigin {
  const { protocol, hostname, host } = window.location;
  return { protocol, hostname, host, isDevServer: import.meta.env.DEV };
}

/** The settings stored in this browser. Empty if the page may not use local storage. */
export function loadStored(): StoredSettings {
  try {
    const stored = parseStored(localStorage.getItem(KEY), ownSignalingUrl(pageOrigin()));
    return { ...stored, visitTokens: parseTokens(JSON.parse(sessionStorage.getItem(VISIT_KEY) ?? '{}')) };
  } catch {
    return {};
  }
}

export function store(settings: StoredSettings): void {
  try {
    const { visitTokens: _, ...kept } = settings;
    const tokens = Object.fromEntries(settings.tokens ?? []);
    localStorage.setItem(KEY, JSON.stringify({ ...kept, tokens }));
  } catch {
    // Private browsing: without storage, settings last for this visit only, in the page's address.
  }
}

/**
 * Takes a token out of the page's address: neither the history, a bookmark nor a shared screen should keep it. The tab
 * remembers it, so that the page can be reloaded.
 *
 * @param settings as they were read from that address
 */
export function hideToken({
  signalingUrl,
  token,
}: {
  signalingUrl: string;
  token: string | undefined;
}): void {
  const address = new URL(window.location.href);
  if (!address.searchParams.has('token')) return;
  address.searchParams.delete('token');
  window.history.replaceState(window.history.state, '', address);
  if (token === undefined) return;
  try {
    const { visitTokens = new Map() } = loadStored();
    keepForVisit(withToken(visitTokens, tokenOrigin(signalingUrl), token));
  } catch {
    // Without storage, the token lasts until the page is reloaded.
  }
}

/** A token that was typed replaces one from an address. */
export function forgetVisitTokens(): void {
  try {
    keepForVisit(new Map());
  } catch {
    // There is none.
  }
}

function keepForVisit(tokens: SignalingTokens): void {
  sessionStorage.setItem(VISIT_KEY, JSON.stringify(Object.fromEntries(tokens)));
}
