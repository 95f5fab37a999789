import { type Broadcast, broadcastCodec, encodeJson, type VideoDescription } from '@farpoint/protocol';
import { CLOUD_MID, midOfVideo } from './broadcast-media.ts';

/** With what the packets of a coded format are decoded. */
export type CloudHeader = NonNullable<Broadcast['clouds']>['streams'][number];

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
    ...{ type: 'farpointBroadcast', version: 1, name },
    videos: videos.map((video, number) => ({ ...video, mid: midOfVideo(number) })),
    ...(sensors.length === 0 ? {} : { clouds }),
  });
}
