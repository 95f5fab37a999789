/** Cameras that are streamed as video. They can be set only in the configuration file. */
import { displayNameSchema, MAX_VIDEOS } from '@farpoint/protocol';
import { topicTableSchema } from '@farpoint/ros';
import { defineOption } from '@farpoint/service';
import { DEFAULT_CAMERA } from '@farpoint/sim';
import {
  LEAST_SOUND_BITS_PER_S,
  MOST_SOUND_BITS_PER_S,
  soundSinkSchema,
  soundSourceSchema,
} from '@farpoint/sound';
import { videoSourceSchema, WANTED_ENCODERS } from '@farpoint/video';
import * as z from 'zod';
import type { SoundOptions } from '../../sense/sound/open-sound-devices.ts';

const [least, most] = [LEAST_SOUND_BITS_PER_S / 1000, MOST_SOUND_BITS_PER_S / 1000];

const soundSchema: z.ZodType<SoundOptions> = z.strictObject({
  microphone: z
    .strictObject({
      source: soundSourceSchema,
      /** Sends less while it is quiet. */
      dtx: z.boolean('must be true or false').default(false),
    })
    .optional(),
  loudspeaker: z.strictObject({ sink: soundSinkSchema }).optional(),
  kbitPerS: z
    .number('must be a number')
    .min(least, `must be at least ${least}`)
    .max(most, `must be at most ${most}`)
    .default(32),
});

/** The robot's microphone and loudspeaker. They can be set only in the configuration file. */
export const soundOptions = {
  sound: defineOption({
    schema: soundSchema,
    default: { kbitPerS: 32 },
    flag: false,
    env: false,
    help: 'a microphone with a source, a loudspeaker with a sink, and kbitPerS of the microphone, 16 to 64; a slow link gets less or none (docs/sound.md)',
  }),
};

const side = z.int('must be a whole number').min(16, 'must be at least 16').max(4096, 'must be at most 4096');

const rate = z.number('must be a number').min(1, 'must be at least 1').max(120, 'must be at most 120');

/** A topic, by the rules of the topic table. Naming it here permits it: it need not be in the table. */
const ros = z
  .strictObject({
    kind: z.literal('ros'),
    topic: z.unknown().optional(),
    type: z.unknown().optional(),
    qos: z.unknown().optional(),
    /** ROS 1 or 2; by default that of the source or the sink. */
    ros: z.literal([1, 2], 'must be 1 or 2').optional(),
  })
  .transform(({ kind, ros: version, ...given }, context) => {
    const { data, error } = topicTableSchema.safeParse([{ ...given, as: 'picture' }]);
    for (const { path, message } of error?.issues ?? [])
      context.addIssue({ code: 'custom', path: path.slice(1), message });
    const [entry] = data ?? [];
    return entry === undefined ? z.NEVER : { kind, version, entry };
  });

const metres = z.number('must be a number').min(-10, 'must be at least -10').max(10, 'must be at most 10');
const radians = z
  .number('must be a number')
  .min(-Math.PI, 'must be at least -π')
  .max(Math.PI, 'must be at most π');
const simSide = z
  .int('must be a whole number')
  .min(16, 'must be at least 16')
  .max(2048, 'must be at most 2048')
  .multipleOf(4, 'must be a multiple of 4');

/** A camera of the simulated robot. Those of equal rates capture at the same instants. */
const sim = z.strictObject({
  kind: z.literal('sim'),
  /** Where it is on the robot, metres ahead of, left of and above base_link. */
  forward: metres.default(DEFAULT_CAMERA.forward),
  left: metres.default(DEFAULT_CAMERA.left),
  up: metres.default(DEFAULT_CAMERA.up),
  /** Radians downwards and to the left. */
  pitch: radians.default(DEFAULT_CAMERA.pitch),
  yaw: radians.default(DEFAULT_CAMERA.yaw),
  /** Horizontal, radians. */
  fieldOfView: z
    .number('must be a number')
    .min(0.1, 'must be at least 0.1')
    .max(2.8, 'must be at most 2.8')
    .default(DEFAULT_CAMERA.fieldOfView),
  width: simSide.default(640),
  height: simSide.default(480),
  framesPerS: rate.default(30),
});

const [test, v4l2, rtsp, gst] = videoSourceSchema.options;
const sourceSchema = z.discriminatedUnion('kind', [test, v4l2, rtsp, gst, ros, sim]);

const cameraSchema = z.strictObject({
  name: displayNameSchema,
  source: sourceSchema,
  encoder: z
    .string('must be text')
    .refine((name) => WANTED_ENCODERS.includes(name), `must be one of ${WANTED_ENCODERS.join(', ')}`)
    .default('auto'),
  width: side.default(1024),
  height: side.default(768),
  framesPerS: rate.default(30),
  kbitPerS: z
    .number('must be a number')
    .min(64, 'must be at least 64')
    .max(50_000, 'must be at most 50000')
    .default(1500),
  /** It is the depth camera's own colour picture: the clouds' lens, place and capture instants. */
  ofCloud: z.boolean('must be true or false').default(false),
});

const videosSchema = z
  .array(cameraSchema)
  .max(MAX_VIDEOS, `must have at most ${MAX_VIDEOS} cameras`)
  .refine(
    (cameras) => new Set(cameras.map(({ name }) => name)).size === cameras.length,
    'must have a different name for each camera',
  )
  .refine(
    (cameras) => cameras.filter(({ ofCloud }) => ofCloud).length <= 1,
    'must have at most one camera with `ofCloud: true`',
  );
export type ConfiguredVideo = z.output<typeof cameraSchema>;

export const videosOptions = {
  videos: defineOption({
    schema: videosSchema,
    default: [],
    flag: false,
    env: false,
    help: 'cameras that are streamed as video, each with a name, a source (test, v4l2, rtsp, ros, sim or gst), an encoder (auto, or one that `pnpm robot doctor` lists), width, height, framesPerS, kbitPerS and ofCloud (the picture of the depth camera that the clouds come from); a slow link gets less (docs/video.md)',
  }),
};
