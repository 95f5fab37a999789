/** The clouds that a page without a robot is shown: fixed scenes and recordings, written once by the robot's own encoders. */
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import type { CloudFile } from '@farpoint/webxr/cloud-file';
import { greyRoomPlaces } from '../grey-room.ts';
import { lidarYardPlaces } from '../lidar-yard.ts';
import { recordedCloud } from './recorded-clouds.ts';
import { organised, points64, unorganised } from './scene-clouds.ts';

/** Each with what makes it. */
const CLOUDS: ReadonlyMap<string, () => Promise<CloudFile>> = new Map([
  /** A grey room of which a software renderer draws the few points at once. */
  ['light', async () => points64(await loadCodecFromDisk(), greyRoomPlaces(0.18))],
  ['grey-room', async () => points64(await loadCodecFromDisk(), greyRoomPlaces())],
  ['lidar-yard', async () => unorganised(await loadCodecFromDisk(), lidarYardPlaces())],
  /** The same room as a depth camera sees it, on its grid. */
  ['depth-room', async () => organised(await loadCodecFromDisk())],
]);

const made = new Map<string, string>();

/** @returns a cloud as JSON; `null` if there is none of this name */
export async function cloudFile(name: string): Promise<string | null> {
  const known = made.get(name);
  if (known !== undefined) return known;
  const cloud = (await CLOUDS.get(name)?.()) ?? (await recordedCloud(name));
  if (cloud === null) return null;
  const json = JSON.stringify(cloud);
  made.set(name, json);
  return json;
}
