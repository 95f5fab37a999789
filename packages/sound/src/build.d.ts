import { type BuildResult } from '@farpoint/native-addon';
export declare const ADDON_FILE: string;
/** How to install what the build, the codec and the devices need. */
export declare const BUILD_REMEDY =
  'install GStreamer 1.22 and a C compiler (Debian: `apt-get install libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-alsa build-essential pkg-config python3`) and run `pnpm build:native sound`';
/** Builds the program if it is missing or its sources have changed. */
export declare function buildAddon(): BuildResult;
