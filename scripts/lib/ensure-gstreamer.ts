import { RtspCamera } from '../../packages/video/src/testing/rtsp-camera.ts';
import { aptInstall } from './apt-install.ts';
import { run } from './run.ts';

/** What the programs for video and sound are built on, and what they and their tests use when they run. */
const PACKAGES = [
  'pkg-config',
  'libgstreamer1.0-dev',
  'libgstreamer-plugins-base1.0-dev',
  'gstreamer1.0-plugins-base',
  'gstreamer1.0-plugins-good',
  'gstreamer1.0-plugins-ugly',
  'gstreamer1.0-plugins-bad',
  'gstreamer1.0-tools',
  ...RtspCamera.PACKAGES,
];
const LIBRARIES = ['gstreamer-1.0', 'gstreamer-app-1.0', 'gstreamer-video-1.0'];
/** One element of each set of plugins. */
const ELEMENTS = ['videotestsrc', 'vp8enc', 'x264enc', 'h264parse', 'opusenc', 'opusdec'];

/** Installs GStreamer, if possible. */
export async function ensureGStreamer(say: (line: string) => void): Promise<void> {
  if (await isThere()) return;
  await aptInstall(PACKAGES, say);
}

async function isThere(): Promise<boolean> {
  if ((await run('pkg-config', ['--exists', ...LIBRARIES])).code !== 0) return false;
  for (const element of ELEMENTS)
    if ((await run('gst-inspect-1.0', ['--exists', element])).code !== 0) return false;
  return !RtspCamera.suite.skip;
}
