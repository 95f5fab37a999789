/** The appearance of clouds that this browser keeps. */
import { isSoftwareRenderer } from '@farpoint/cloud-view';
import type { Settings } from '../ground/settings.ts';
import {
  appearanceText,
  CloudAppearance,
  parseAppearance,
  type StoredAppearance,
} from './cloud-appearance.ts';

const KEY = 'farpoint.clouds';

/** @param asked what the page's address says; it comes before what is stored */
export function openAppearance(
  asked: Pick<Settings, 'surface' | 'memory' | 'paint'>,
  gl: WebGLRenderingContext | WebGL2RenderingContext,
): CloudAppearance {
  const stored = load();
  const [surface, memory] = [asked.surface ?? stored.surface, asked.memory ?? stored.memory];
  const wanted = { ...stored, surface, memory, paint: asked.paint ?? stored.paint };
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
