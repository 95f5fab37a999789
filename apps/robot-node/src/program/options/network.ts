/** Network paths to the operators. */
import { type IceServer, iceServerSchema } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const iceUrlSchema = z
  .string('must be an address')
  .regex(/^(stun|turns?):\S+$/, 'must begin with stun:, turn: or turns:');

/** An RTCIceServer: an address alone, or with credentials. */
const iceServer = z.preprocess(
  (value) => (typeof value === 'string' ? { urls: value } : value),
  z.strictObject({
    ...iceServerSchema.shape,
    urls: z.union([iceUrlSchema, z.array(iceUrlSchema)], 'must begin with stun:, turn: or turns:'),
  }),
) as z.ZodType<IceServer>;

/** In a file, a list. As text, addresses separated by commas, or the list as JSON. */
const iceServers = z.preprocess(
  (value, context) => {
    if (typeof value !== 'string') return value;
    if (!value.trimStart().startsWith('['))
      return value
        .split(',')
        .map((part) => part.trim())
        .filter((part) => part !== '');
    try {
      return JSON.parse(value) as unknown;
    } catch {
      context.addIssue({ code: 'custom', message: 'must be addresses, or a list of RTCIceServer as JSON' });
      return z.NEVER;
    }
  },
  z.array(iceServer, 'must be a list'),
) as z.ZodType<IceServer[]>;

/** `40000-40100`: first and last port. */
const portRange = z.preprocess(
  (value, context) => {
    const match = /^(\d{1,5})-(\d{1,5})$/.exec(String(value));
    const [low, high] = [Number(match?.[1]), Number(match?.[2])];
    if (match !== null && low >= 1 && low <= high && high <= 65_535) return [low, high];
    context.addIssue({ code: 'custom', message: 'must be two ports, the lower first, e.g. 40000-40100' });
    return z.NEVER;
  },
  z.tuple([z.number(), z.number()]),
) as z.ZodType<[number, number]>;

export const networkOptions = optionGroup('network', {
  icePolicy: defineOption({
    schema: schema.choice(['all', 'relay']),
    default: 'all',
    argument: 'POLICY',
    help: 'all: any path to the operators; relay: only through TURN servers',
  }),
  iceServers: defineOption({
    schema: iceServers,
    default: [],
    argument: 'URLS',
    secret: true,
    help: 'STUN or TURN servers in addition to those of the signaling service: addresses, or {urls, username, credential}',
  }),
  udpPorts: defineOption({
    schema: schema.optional(portRange),
    default: null,
    argument: 'LOW-HIGH',
    help: 'local UDP ports for operators’ connections; default: any',
  }),
});
