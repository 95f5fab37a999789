/** What the process says in JSON, checked. */
import * as z from 'zod';
import { VIDEO_FAILURE_REASONS } from './video-failure.ts';
import { VideoWireError } from './wire.ts';

const count = z.int().min(0);

const playing = z.object({
  state: z.literal('playing'),
  codec: z.enum(['h264', 'vp8']),
  encoder: z.string(),
  /** Of the encoded pictures. */
  width: count,
  height: count,
  /** Of the source's. */
  sourceWidth: count,
  sourceHeight: count,
});

/** Counts since the process started, and encode times of the last second. */
const stats = z.object({
  state: z.literal('stats'),
  framesIn: count,
  /** Left out because a lower rate is wanted. */
  skipped: count,
  /** Left out because the encoder, or whoever takes its output, was too slow. */
  dropped: count,
  encoded: count,
  keyFrames: count,
  bytes: count,
  /** Raw pictures whose message was not valid. */
  refused: count,
  /** Coded pictures that the decoder could not read. */
  damaged: count,
  /** Coded pictures left out because the decoder was too slow, or because one that they need was missing. */
  undecoded: count,
  encodeMs: z.number().min(0),
  mostEncodeMs: z.number().min(0),
});

const stateSchema = z.discriminatedUnion('state', [playing, stats]);
export type VideoState = z.infer<typeof stateSchema>;
export type VideoPlaying = z.infer<typeof playing>;
export type VideoStats = z.infer<typeof stats>;

const errorSchema = z.object({
  reason: z.enum(VIDEO_FAILURE_REASONS),
  said: z.string(),
  detail: z.string(),
});
export type ProcessError = z.infer<typeof errorSchema>;

const encodersSchema = z.object({
  gstreamer: z.string(),
  encoders: z.array(z.object({ name: z.string(), codec: z.enum(['h264', 'vp8']) })),
});
export type EncoderList = z.infer<typeof encodersSchema>;

const logSchema = z.object({ level: z.enum(['debug', 'warn', 'error']), msg: z.string() });
export type LogLine = z.infer<typeof logSchema>;

export const parseState = (payload: Uint8Array): VideoState => parse(stateSchema, payload, 'a state');
export const parseError = (payload: Uint8Array): ProcessError => parse(errorSchema, payload, 'an error');
export const parseEncoders = (text: Uint8Array): EncoderList =>
  parse(encodersSchema, text, 'a list of encoders');

/** A line of the standard error. Plugins write there, too, as they like. */
export function parseLogLine(line: string): LogLine {
  try {
    const result = logSchema.safeParse(JSON.parse(line));
    if (result.success) return result.data;
  } catch {
    // Not JSON.
  }
  return { level: 'warn', msg: line };
}

function parse<T>(schema: z.ZodType<T>, payload: Uint8Array, what: string): T {
  try {
    return schema.parse(JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(payload)));
  } catch (cause) {
    throw new VideoWireError('bad-message', `${what} that is not valid`, { cause });
  }
}
