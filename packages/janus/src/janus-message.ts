/**
 * What Janus says over its WebSocket (https://janus.conf.meetecho.com/docs/rest.html). Members that we do not use are
 * ignored: other versions have others.
 */
import * as z from 'zod/mini';

const transaction = z.optional(z.string());
const sender = z.optional(z.number());

const jsepSchema = z.object({
  type: z.enum(['offer', 'answer']),
  sdp: z.string().check(z.maxLength(60_000)),
});
export type Jsep = z.infer<typeof jsepSchema>;

const candidateSchema = z.union([
  z.object({ completed: z.literal(true) }),
  z.object({
    candidate: z.string().check(z.maxLength(1024)),
    sdpMid: z.optional(z.nullable(z.string())),
    sdpMLineIndex: z.optional(z.nullable(z.number())),
  }),
]);
export type JanusCandidate = z.infer<typeof candidateSchema>;

const janusMessageSchema = z.discriminatedUnion('janus', [
  z.object({
    janus: z.literal('success'),
    transaction,
    data: z.optional(z.object({ id: z.number() })),
    plugindata: z.optional(z.object({ data: z.unknown() })),
  }),
  z.object({
    janus: z.literal('error'),
    transaction,
    error: z.object({ code: z.number(), reason: z.string() }),
  }),
  z.object({ janus: z.literal('ack'), transaction }),
  z.object({
    janus: z.literal('event'),
    transaction,
    sender,
    plugindata: z.object({ data: z.unknown() }),
    jsep: z.optional(jsepSchema),
  }),
  z.object({ janus: z.literal('trickle'), sender, candidate: candidateSchema }),
  z.object({ janus: z.literal('webrtcup'), sender }),
  z.object({ janus: z.literal('hangup'), sender, reason: z.optional(z.string()) }),
  z.object({ janus: z.literal('detached'), sender }),
  z.object({ janus: z.literal('timeout') }),
  z.object({ janus: z.literal('media'), sender }),
  z.object({ janus: z.literal('slowlink'), sender }),
]);
export type JanusMessage = z.infer<typeof janusMessageSchema>;

/** Longer messages are refused; an offer with eight videos takes some 12 kB. */
export const MAX_JANUS_MESSAGE = 256 * 1024;

/** @returns `null` for anything that is not such a message */
export function readJanusMessage(text: unknown): JanusMessage | null {
  if (typeof text !== 'string' || text.length > MAX_JANUS_MESSAGE) return null;
  try {
    const parsed = z.safeParse(janusMessageSchema, JSON.parse(text));
    return parsed.success ? parsed.data : null;
  } catch {
    return null;
  }
}
