/** Cameras that are streamed as video. They can be set only in the configuration file. */
import { displayNameSchema, MAX_VIDEOS } from '@farpoint/protocol';
import { defineOption } from '@farpoint/service';
import { videoSourceSchema, WANTED_ENCODERS } from '@farpoint/video';
import * as z from 'zod';

const side = z.int('must be a whole number').min(16, 'must be at least 16').max(4096, 'must be at most 4096');

const cameraSchema = z.strictObject({
  name: displayNameSchema,
  source: videoSourceSchema,
  encoder: z
    .string('must be text')
    .refine((name) => WANTED_ENCODERS.includes(name), `must be one of ${WANTED_ENCODERS.join(', ')}`)
    .default('auto'),
  width: side.default(1024),
  height: side.default(768),
  framesPerS: z
    .number('must be a number')
    .min(1, 'must be at least 1')
    .max(120, 'must be at most 120')
    .default(30),
  kbitPerS: z
    .number('must be a number')
    .min(64, 'must be at least 64')
    .max(50_000, 'must be at most 50000')
    .default(1500),
});

const videosSchema = z
  .array(cameraSchema)
  .max(MAX_VIDEOS, `must have at most ${MAX_VIDEOS} cameras`)
  .refine(
    (cameras) => new Set(cameras.map(({ name }) => name)).size === cameras.length,
    'must have a different name for each camera',
  );
export type VideoCameraOptions = z.output<typeof cameraSchema>;

export const videosOptions = {
  videos: defineOption({
    schema: videosSchema,
    default: [],
    flag: false,
    env: false,
    help: 'cameras that are streamed as video, each with a name, a source, an encoder (auto, or one that `pnpm robot doctor` lists), width, height, framesPerS and kbitPerS; a slow link gets less (docs/video.md)',
  }),
};
