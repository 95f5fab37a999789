/** The robot's microphone and loudspeaker. They can be set only in the configuration file. */
import { defineOption } from '@farpoint/service';
import {
  LEAST_SOUND_BITS_PER_S,
  MOST_SOUND_BITS_PER_S,
  soundSinkSchema,
  soundSourceSchema,
} from '@farpoint/sound';
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

export const soundOptions = {
  sound: defineOption({
    schema: soundSchema,
    default: { kbitPerS: 32 },
    flag: false,
    env: false,
    help: 'a microphone with a source, a loudspeaker with a sink, and kbitPerS of the microphone, 16 to 64; a slow link gets less or none (docs/sound.md)',
  }),
};
