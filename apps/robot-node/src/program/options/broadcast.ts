/** The broadcast to any number of viewers, through Janus. */
import { defineOption, type OptionValues, optionGroup, schema } from '@farpoint/service';
import { BitRate } from '@farpoint/timing';
import * as z from 'zod';
import { type BroadcastOptions, isLoopback } from '../../serve/broadcast/broadcast-options.ts';

export const broadcastOptions = optionGroup('broadcast', {
  broadcastJanus: defineOption({
    schema: schema.optional(z.url({ protocol: /^wss?$/, error: 'must be a ws:// or wss:// address' })),
    default: null,
    argument: 'URL',
    file: 'janus',
    help: 'feed this Janus once, for any number of viewers (docs/janus.md): address of its WebSocket',
  }),
  broadcastAdminKey: defineOption({
    schema: schema.optional(schema.secret(schema.text({ max: 256 }))),
    default: null,
    argument: 'KEY',
    file: 'adminKey',
    secret: true,
    help: 'admin key of Janus’ streaming plugin',
  }),
  broadcastMountpoint: defineOption({
    schema: schema.integer({ min: 1, max: 2 ** 31 - 1 }),
    default: 1,
    argument: 'NUMBER',
    file: 'mountpoint',
    help: 'number of the robot’s mountpoint, different for each robot at one Janus',
  }),
  broadcastPin: defineOption({
    schema: schema.optional(schema.secret(schema.text({ max: 64 }))),
    default: null,
    argument: 'PIN',
    file: 'pin',
    secret: true,
    help: 'asked of everybody who wants to watch',
  }),
  broadcastMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 4,
    argument: 'MBPS',
    file: 'mbps',
    help: 'most that the broadcast takes of the uplink, 10^6 bit/s on the wire; Janus reports no losses, so choose what the uplink always carries',
  }),
  broadcastClouds: defineOption({
    schema: schema.boolean(),
    default: true,
    file: 'clouds',
    help: 'broadcast clouds, too, not only videos',
  }),
  broadcastHost: defineOption({
    schema: schema.optional(schema.text({ max: 253 })),
    default: null,
    argument: 'HOST',
    file: 'host',
    help: 'where Janus takes RTP, if not at the host of its WebSocket',
  }),
});

/**
 * Each viewer that asks for a key frame costs all viewers bits; a viewer who joins waits this long at most.
 * Chosen: docs/janus.md says it.
 */
const KEY_FRAME_MS = 2000;

type BroadcastKey = keyof typeof broadcastOptions;

/** @param refuse told what is wrong with the options in combination */
export function toBroadcast(
  values: OptionValues<typeof broadcastOptions> & { plaintextToken: boolean },
  ca: string | null,
  refuse: (key: BroadcastKey, detail: string) => void,
): BroadcastOptions | undefined {
  const { broadcastJanus: url } = values;
  if (url === null) return undefined;
  const { protocol, hostname } = new URL(url);
  if (protocol === 'ws:' && !isLoopback(hostname) && !values.plaintextToken) {
    refuse(
      'broadcastJanus',
      'must be a wss:// address on another machine, because the keys of the streams are sent there (--plaintext-token allows ws://)',
    );
  }
  return {
    url,
    ca,
    host: values.broadcastHost,
    clouds: values.broadcastClouds,
    adminKey: values.broadcastAdminKey,
    mountpoint: values.broadcastMountpoint,
    pin: values.broadcastPin,
    bitsPerSecond: BitRate.fromMbps(values.broadcastMbps),
    keyFrameMs: KEY_FRAME_MS,
  };
}
