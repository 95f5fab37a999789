/** What the process says in JSON, checked. */
import { parseWireJson } from '@farpoint/media-process';
import * as z from 'zod';
import { SOUND_FAILURE_REASONS } from './sound-failure.ts';

const count = z.int().min(0);

const stateSchema = z.discriminatedUnion('state', [
  /** The device could be opened, or is being opened: what goes wrong from now on is an error. */
  z.object({ state: z.literal('started') }),
  /** Each second, since the process started. */
  z.object({ state: z.literal('stats'), packets: count, bytes: count }),
]);
export type SoundState = z.infer<typeof stateSchema>;

const errorSchema = z.object({
  reason: z.enum(SOUND_FAILURE_REASONS),
  said: z.string(),
  detail: z.string(),
});

export const parseState = (payload: Uint8Array): SoundState => parseWireJson(stateSchema, payload, 'a state');
export const parseError = (payload: Uint8Array) => parseWireJson(errorSchema, payload, 'an error');
