import {
  type Broadcast,
  broadcastCodec,
  encodeJson,
  type VideoCodec,
  type VideoDescription,
} from '@farpoint/protocol';
import { CLOUD_MID, midOfVideo } from './broadcast-media.ts';

/** With what the packets of a coded format are decoded. */
export type CloudHeader = NonNullable<Broadcast['clouds']>['streams'][number];

/**
 * The videos as a broadcast has them: with the codecs of its m-lines, and without pictures while the robot encodes a
 * video with another.
 */
export function asBroadcast(
  videos: readonly Omit<VideoDescription, 'mid'>[],
  codecs: readonly VideoCodec[],
): Omit<VideoDescription, 'mid'>[] {
  return videos.map(({ codec: now, ...video }, number) => {
    const codec = codecs[number] ?? now;
    const other = `the robot encodes it as ${now} at present, for an operator who does not decode ${codec}`;
    return { ...(codec === now ? {} : { fault: other }), ...video, codec };
  });
}

/**
 * What viewers are told, as the mountpoint's metadata.
 *
 * @param sensors whose clouds are broadcast; none for a broadcast without clouds
 */
export function describeBroadcast(
  name: string,
  videos: readonly Omit<VideoDescription, 'mid'>[],
  sensors: readonly { name: string }[],
  streams: readonly CloudHeader[],
): string {
  const clouds = {
    mid: CLOUD_MID,
    sensors: sensors.map((sensor) => ({ name: sensor.name })),
    streams: [...streams],
  };
  return encodeJson(broadcastCodec, {
    type: 'farpointBroadcast',
    version: 1,
    name,
    videos: videos.map((video, number) => ({ ...video, mid: midOfVideo(number) })),
    ...(sensors.length === 0 ? {} : { clouds }),
  });
}
