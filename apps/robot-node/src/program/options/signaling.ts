/** The connection to the signaling service. */
import { handleSchema, tokenSchema } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const signalingUrlSchema = z
  .url({ protocol: /^wss?$/, error: 'must be a ws:// or wss:// address' })
  .refine((url) => !URL.canParse(url) || new URL(url).search === '', 'must have no query');

export const signalingOptions = optionGroup('signaling', {
  signaling: defineOption({
    schema: signalingUrlSchema,
    default: 'ws://127.0.0.1:3000',
    argument: 'URL',
    file: 'url',
    help: 'address of the signaling service, ws:// or wss://',
  }),
  tlsCa: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'PEM file with the certificate authorities to trust for wss://, instead of the system’s',
  }),
  token: defineOption({
    schema: schema.optional(schema.secret(tokenSchema)),
    default: null,
    argument: 'TOKEN',
    secret: true,
    help: 'token that the signaling service requires',
  }),
  plaintextToken: defineOption({
    schema: schema.boolean(),
    default: false,
    help: 'send the token, and Janus’ keys, even over ws:// to another machine, where others on the way can read them',
  }),
  key: defineOption({
    schema: schema.optional(schema.secret(handleSchema)),
    default: null,
    argument: 'KEY',
    secret: true,
    help: 'proves to the signaling service, also after a restart, that this is the same robot; default: random',
  }),
  referenceSignaling: defineOption({
    schema: schema.optional(signalingUrlSchema),
    default: null,
    argument: 'URL',
    file: 'referenceUrl',
    help: 'also register at this address, the robot port of the reference system’s signaling; anyone who connects there may watch and drive without authentication',
  }),
});
