import * as z from 'zod/mini';
import { type Twist, twistSchema } from './geometry.ts';
import type { JsonCodec } from './json.ts';

/**
 * The reference system's control message: a bare twist, UTF-8 JSON sent as a binary message. `linear.z ≠ 0` requests a
 * latency-test frame and is no motion.
 */
export const referenceControlCodec: JsonCodec<Twist> = {
  what: 'reference control message',
  schema: z.object(twistSchema.shape),
  maxBytes: 1024,
};
