import * as z from 'zod';

/** A pipeline in GStreamer's own words, as a camera or a sound device of the robot's configuration. */
export const gstPipelineSchema = z.strictObject({
  kind: z.literal('gst'),
  /** Any elements whose last one gives, or whose first one takes, what is raw. Trusted: it can do what GStreamer can. */
  pipeline: z
    .string('must be text')
    .min(1, 'must not be empty')
    .max(8000, 'must have at most 8000 characters')
    .refine((text) => !text.includes('\0'), 'must not contain a zero byte'),
});

/** GStreamer's messages name addresses, and those may contain a password. */
export function withoutPasswords(text: string): string {
  return text.replaceAll(/(\w+:\/\/)[^/?#\s"]*@/g, '$1…@');
}
