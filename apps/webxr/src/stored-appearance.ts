/** The appearance of clouds that this browser keeps. */
import { isSoftwareRenderer } from '@farpoint/cloud-view';
import {
  appearanceText,
  CloudAppearance,
  parseAppearance,
  type StoredAppearance,
} from './state/cloud-appearance.ts';

const KEY = 'farpoint.clouds';

/** @param surface whether clouds are drawn as surfaces, if the page's address says so */
export function openAppearance(
  surface: boolean | null,
  gl: WebGLRenderingContext | WebGL2RenderingContext,
): CloudAppearance {
  const stored = load();
  const wanted = { ...stored, surface: surface ?? stored.surface };
  return new CloudAppearance(wanted, store, !isSoftwareRenderer(gl));
}

/** The defaults if the page may not use local storage. */
function load(): StoredAppearance {
  try {
    return parseAppearance(localStorage.getItem(KEY));
  } catch {
    return parseAppearance(null);
  }
}

function store(appearance: StoredAppearance): void {
  try {
    localStorage.setItem(KEY, appearanceText(appearance));
  } catch {
    // Private browsing: what is chosen lasts for this visit only.
  }
}
