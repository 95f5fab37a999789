/** What a robot says about its broadcast to those who watch it through a relay. */
import * as z from 'zod/mini';
import { CLOUD_FORMATS } from './cloud-format.ts';
import { displayNameSchema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';
import { MAX_SENSORS } from './placement.ts';
import { sensorSchema } from './sensor-rings.ts';
import { midSchema, streamHeaderSchema, videoDescriptionSchema } from './session-codecs.ts';
import type { CloudStream } from './session-messages.ts';
import { MAX_VIDEOS, type VideoDescription } from './video-media.ts';

/** The metadata of a robot's mountpoint. */
export interface Broadcast {
  /** Tells it from the metadata of others. */
  type: 'farpointBroadcast';
  /** Version of this description. */
  version: 1;
  /** The robot's name, for people. */
  name: string;
  /** The videos, each on an m-line of its own. */
  videos: VideoDescription[];
  /** The clouds of all sensors, on one m-line; absent if there are none. */
  clouds?:
    | {
        /** `a=mid` of their m-line. */
        mid: string;
        /** A sensor's position in the list is its number in the placement. */
        sensors: {
          /** For people. */
          name: string;
        }[];
        /** With what the packets of coded formats are decoded now. */
        streams: {
          /** Of the packets that it decodes. */
          format: CloudStream['format'];
          /** The format's own stream header, base64. */
          header: string;
          /** Number of the sensor. */
          sensor: number;
        }[];
      }
    | undefined;
}

export const broadcastCodec: JsonCodec<Broadcast> = {
  what: 'broadcast description',
  schema: z.strictObject({
    type: z.literal('farpointBroadcast'),
    version: z.literal(1),
    name: displayNameSchema,
    videos: z.array(videoDescriptionSchema).check(z.maxLength(MAX_VIDEOS)),
    clouds: z.optional(
      z.strictObject({
        mid: midSchema,
        sensors: z
          .array(z.strictObject({ name: displayNameSchema }))
          .check(z.minLength(1), z.maxLength(MAX_SENSORS)),
        streams: z
          .array(
            z.strictObject({
              format: z.enum(['organised', 'unorganised']),
              header: streamHeaderSchema,
              sensor: sensorSchema,
            }),
          )
          .check(z.maxLength(MAX_SENSORS * (CLOUD_FORMATS.length - 1))),
      }),
    ),
  }),
  maxBytes: 65_536,
};
