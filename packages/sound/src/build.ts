/** Location of the program, and building it. GStreamer comes from the system. */
import { join } from 'node:path';
import { MEDIA_PROCESS_SOURCES } from '@farpoint/media-process/sources';
import { addonFile, type BuildResult, buildNativeAddon } from '@farpoint/native-addon';

const PROGRAM = {
  folder: join(import.meta.dirname, '..', 'native'),
  shared: [MEDIA_PROCESS_SOURCES],
  name: 'farpoint-sound',
  kind: 'program',
} as const;
export const ADDON_FILE = addonFile(PROGRAM);

/** How to install what the build, the codec and the devices need. */
export const BUILD_REMEDY =
  'install GStreamer 1.22 and a C compiler (Debian: `apt-get install libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-alsa build-essential pkg-config python3`) and run `pnpm build:native sound`';

/** Builds the program if it is missing or its sources have changed. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'the sound program is tried on Linux only' };
  return buildNativeAddon(PROGRAM);
}
