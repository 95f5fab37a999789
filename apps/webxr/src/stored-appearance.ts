/** The appearance of clouds that this browser keeps. */
import { appearanceText, parseAppearance, type StoredAppearance } from './state/cloud-appearance.ts';

const KEY = 'farpoint.clouds';

/** The defaults if the page may not use local storage. */
export function loadAppearance(): StoredAppearance {
  try {
    return parseAppearance(localStorage.getItem(KEY));
  } catch {
    return parseAppearance(null);
  }
}

export function storeAppearance(appearance: StoredAppearance): void {
  try {
    localStorage.setItem(KEY, appearanceText(appearance));
  } catch {
    // Private browsing: what is chosen lasts for this visit only.
  }
}
