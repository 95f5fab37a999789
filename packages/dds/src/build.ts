/** Location of the addon, and building it. CycloneDDS comes from the system, or from `CYCLONEDDS_HOME`. */
import { join } from 'node:path';
import { addonFile, type BuildResult, buildNativeAddon } from '@farpoint/native-addon';

const ADDON = {
  folder: join(import.meta.dirname, '..', 'native'),
  name: 'farpoint_dds',
  depends: process.env.CYCLONEDDS_HOME ?? '',
};
export const ADDON_FILE = addonFile(ADDON);

/** How to install what the build needs. */
export const BUILD_REMEDY =
  'install CycloneDDS 0.10 and a C compiler (Debian: `apt-get install cyclonedds-dev build-essential python3`) and run `pnpm build:native dds`';

/** Builds the addon if it is missing or its sources have changed. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'DDS is tried on Linux only' };
  return buildNativeAddon(ADDON);
}
