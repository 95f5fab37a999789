/** The dashboard's layout that this browser keeps. */
import { type Layout, layoutText, parseLayout } from './layout.ts';

const KEY = 'farpoint.dashboard';

/** The defaults if the page may not use local storage. */
export function loadLayout(): Layout {
  try {
    return parseLayout(localStorage.getItem(KEY));
  } catch {
    return parseLayout(null);
  }
}

export function storeLayout(layout: Layout): void {
  try {
    localStorage.setItem(KEY, layoutText(layout));
  } catch {
    // Private browsing: what is arranged lasts for this visit only.
  }
}
