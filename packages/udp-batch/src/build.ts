/** Location of the addon, and building it. */
import { join } from 'node:path';
import { addonFile, type BuildResult, buildNativeAddon } from '@farpoint/native-addon';

const ADDON = { folder: join(import.meta.dirname, '..', 'native'), name: 'farpoint_udp_batch' };
export const ADDON_FILE = addonFile(ADDON);

/** How to install what the build needs. */
export const BUILD_REMEDY =
  'install a C compiler, make and Python 3 (Debian: `apt-get install build-essential python3`) and run `pnpm build:native`';

/** Builds the addon if it is missing or its sources have changed. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'sendmmsg needs Linux' };
  return buildNativeAddon(ADDON);
}
