/** What the streaming plugin answers and reports (https://janus.conf.meetecho.com/docs/streaming). */
import * as z from 'zod/mini';

const port = z.number().check(z.int(), z.minimum(1), z.maximum(65_535));

export const failureSchema = z.object({ error_code: z.number(), error: z.string() });

export const createdSchema = z.object({
  streaming: z.literal('created'),
  stream: z.object({
    id: z.number(),
    ports: z.array(z.object({ mid: z.string(), port, rtcp_port: z.optional(port) })),
  }),
});
export type CreatedMountpoint = z.infer<typeof createdSchema>['stream'];

export const infoSchema = z.object({
  streaming: z.literal('info'),
  info: z.object({
    id: z.number(),
    enabled: z.optional(z.boolean()),
    metadata: z.optional(z.string()),
    /** Only for those who know the mountpoint's secret. */
    viewers: z.optional(z.number()),
    media: z.array(
      z.object({
        mid: z.string(),
        type: z.enum(['audio', 'video', 'data']),
        label: z.optional(z.string()),
        codec: z.optional(z.string()),
        /** Since the last packet of the source, ms. */
        age_ms: z.optional(z.number()),
      }),
    ),
  }),
});
export type MountpointInfo = z.infer<typeof infoSchema>['info'];

export const doneSchema = z.object({ streaming: z.enum(['destroyed', 'edited', 'ok']) });

/** What comes without being asked for, and the answers to `watch` and `start`. */
export const streamingEventSchema = z.union([
  // The documentation has `streaming` for `event`.
  z.object({ event: z.literal('edited'), metadata: z.string() }),
  z.object({ streaming: z.literal('edited'), metadata: z.string() }),
  z.object({
    streaming: z.literal('event'),
    result: z.object({ status: z.optional(z.string()) }),
  }),
  z.object({ streaming: z.literal('event'), error_code: z.number(), error: z.string() }),
]);
export type StreamingEvent = z.infer<typeof streamingEventSchema>;

/** One m-line of a mountpoint that is to be created. */
export interface MountpointMedia {
  mid: string;
  type: 'audio' | 'video';
  /** For people. */
  label: string;
  codec: 'opus' | 'h264' | 'vp8';
  /** RTP payload type. */
  pt: number;
  fmtp?: string | undefined;
}

/** A mountpoint that is to be created. */
export interface MountpointRequest {
  id: number;
  name: string;
  description: string;
  /** For those who watch. */
  metadata: string;
  secret: string;
  pin: string | null;
  adminKey: string | null;
  media: readonly MountpointMedia[];
  /** Where Janus takes the packets: an address of its machine; all if `null`. */
  address: string | null;
  /** Master key and salt, 30 bytes, for AES_CM_128_HMAC_SHA1_80 (RFC 3711); `null` for packets in clear. */
  srtp: Uint8Array | null;
}

/** The body of the plugin's `create` request. Janus chooses the ports. */
export function createBody({ adminKey, pin, media, address, srtp, ...rest }: MountpointRequest): object {
  return {
    request: 'create',
    type: 'rtp',
    ...rest,
    permanent: false,
    is_private: false,
    ...(adminKey === null ? {} : { admin_key: adminKey }),
    ...(pin === null ? {} : { pin }),
    ...(srtp === null ? {} : { srtpsuite: 80, srtpcrypto: base64(srtp) }),
    media: media.map(({ fmtp, ...each }) => ({
      ...each,
      port: 0,
      rtcpport: 0,
      ...(fmtp === undefined ? {} : { fmtp }),
      ...(address === null ? {} : { iface: address }),
    })),
  };
}

function base64(bytes: Uint8Array): string {
  return btoa(String.fromCharCode(...bytes));
}
