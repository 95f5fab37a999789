/** Where the addon is, and building it: CycloneDDS is taken from the system, or from where `CYCLONEDDS_HOME` says. */
import { join } from 'node:path';
import { addonFile, type BuildResult, buildNativeAddon } from '@farpoint/native-addon';

const ADDON = {
  folder: join(import.meta.dirname, '..', 'native'),
  name: 'farpoint_dds',
  depends: process.env.CYCLONEDDS_HOME ?? '',
};
export const ADDON_FILE = addonFile(ADDON);

/** How to get what the build needs. */
export const BUILD_REMEDY =
  'install CycloneDDS 0.10 and a C compiler (Debian: `apt-get install cyclonedds-dev build-essential python3`) and run `pnpm build:native dds`';

/** Builds it where its sources have changed since the last time, or it is not there. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'DDS is tried on Linux only' };
  return buildNativeAddon(ADDON);
}
