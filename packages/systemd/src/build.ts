/** Where the addon is, and building it. */
import { join } from 'node:path';
import { addonFile, type BuildResult, buildNativeAddon } from '@farpoint/native-addon';

const ADDON = { folder: join(import.meta.dirname, '..', 'native'), name: 'farpoint_systemd' };
export const ADDON_FILE = addonFile(ADDON);

/** How to get what the build needs. */
export const BUILD_REMEDY =
  'install a C compiler, make and Python 3 (Debian: `apt-get install build-essential python3`) and run `pnpm build:native`';

/** Builds it where its sources have changed since the last time, or it is not there. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'systemd needs Linux' };
  return buildNativeAddon(ADDON);
}
