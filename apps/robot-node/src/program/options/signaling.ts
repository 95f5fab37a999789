/** The connection to the signaling service. */
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { defineOption, type OptionTable, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';
import { LIST_STATUSES } from '../../tell/status-reporter.ts';

/** The robot's identity, and its role in the system that it runs on. */
export const identityOptions = {
  id: defineOption({
    schema: robotIdSchema,
    default: 'robot-1',
    argument: 'ID',
    help: 'the robot’s id at the signaling service: a–z 0–9 . _ -',
  }),
  name: defineOption({
    schema: displayNameSchema,
    default: 'Robot',
    argument: 'NAME',
    help: 'name that operators see',
  }),
  niceness: defineOption({
    schema: schema.integer({ min: -20, max: 19 }),
    default: -5,
    argument: 'N',
    help: 'priority of this process, if the system permits it; commands and packets should not wait for the processor',
  }),
} satisfies OptionTable;

/** The robot’s model, which operators see. */
export const modelOptions = {
  urdf: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'the robot’s model for operators: a URDF file, or none; default: of a topic with `as: model`, and the simulated robot’s own',
  }),
};

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
  listStatus: defineOption({
    schema: schema.choice(LIST_STATUSES),
    default: 'state',
    argument: 'LEVEL',
    help: 'what the list of robots shows to operators without a session: state (what the robot does, battery, alarms, how many operators, version), names (also who drives) or off (only the robot’s name)',
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
