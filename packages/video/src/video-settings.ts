/** What may change while a camera is encoded. */
import * as z from 'zod';
import { BARCODE_CLOCKS } from './wire.ts';

/** Of a picture, pixels. */
export const sideSchema = z
  .int('must be a whole number')
  .min(16, 'must be at least 16')
  .max(8192, 'must be at most 8192');

export const videoSettingsSchema = z.strictObject({
  bitsPerS: z
    .number('must be a number')
    .min(10_000, 'must be at least 10000')
    .max(200_000_000, 'must be at most 200000000'),
  /** Pictures that the source gives beyond that are left out; by default none. */
  framesPerS: z
    .number('must be a number')
    .min(0.1, 'must be at least 0.1')
    .max(240, 'must be at most 240')
    .optional(),
  /** The picture is made smaller until it fits into this, with its proportions kept; by default it is not. */
  width: sideSchema.optional(),
  height: sideSchema.optional(),
  /** Draws the capture time into the picture, by this clock (docs/protocol.md, "Latency barcode"). */
  barcode: z.enum(BARCODE_CLOCKS, 'must be monotonic or unix').optional(),
});
export type VideoSettings = z.infer<typeof videoSettingsSchema>;
