/**
 * `pnpm build:native [shared-memory] [gpio] [systemd] [udp-batch] [dds] [video] [sound]`: builds the native addons and
 * the programs for video and sound; without a name, all of them. In that case DDS, video and sound may be missing,
 * because they need libraries that not every robot has.
 */
import * as dds from '../packages/dds/src/build.ts';
import * as gpio from '../packages/gpio/src/build.ts';
import * as sharedMemory from '../packages/shared-memory/src/build.ts';
import * as sound from '../packages/sound/src/build.ts';
import * as systemd from '../packages/systemd/src/build.ts';
import * as udpBatch from '../packages/udp-batch/src/build.ts';
import * as video from '../packages/video/src/build.ts';

const addons = {
  'shared-memory': { ...sharedMemory, what: 'shared memory', optional: false },
  gpio: { ...gpio, what: 'a stop by GPIO', optional: false },
  systemd: { ...systemd, what: 'the systemd unit', optional: false },
  'udp-batch': { ...udpBatch, what: 'sending many packets by one system call', optional: false },
  dds: { ...dds, what: 'ROS 2 (--source ros2, --sink ros2)', optional: true },
  video: { ...video, what: 'camera video', optional: true },
  sound: { ...sound, what: 'sound', optional: true },
};

const asked = process.argv.slice(2);
const unknown = asked.find((name) => !(name in addons));
if (unknown !== undefined) {
  console.error(`there is no addon ${unknown}; the addons are ${Object.keys(addons).join(' and ')}`);
  process.exit(2);
}
for (const [name, { buildAddon, ADDON_FILE, BUILD_REMEDY, what, optional }] of Object.entries(addons)) {
  if (asked.length > 0 && !asked.includes(name)) continue;
  const { ok, output } = buildAddon();
  if (ok) {
    console.log(`built ${ADDON_FILE}`);
    continue;
  }
  const needed = asked.includes(name) || !optional;
  if (needed) console.error(output.trimEnd());
  console.error(`${what} cannot be used here: ${BUILD_REMEDY}`);
  if (needed) process.exitCode = 1;
}
