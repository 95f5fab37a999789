/** Ways to the operators. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

export const networkOptions = optionGroup('network', {
  icePolicy: defineOption({
    schema: schema.choice(['all', 'relay']),
    default: 'all',
    argument: 'POLICY',
    help: 'relay: reach operators by TURN servers only',
  }),
  iceServers: defineOption({
    schema: schema.list(z.string().regex(/^(stun|turns?):/, 'must begin with stun:, turn: or turns:')),
    default: [],
    argument: 'URLS',
    help: 'STUN or TURN servers besides those of the signaling service',
  }),
  udpPorts: defineOption({
    schema: schema.optional(
      z
        .string()
        .regex(/^\d{1,5}-\d{1,5}$/, 'must be two ports, e.g. 40000-40100')
        .refine((text) => {
          const [low, high] = text.split('-').map(Number) as [number, number];
          return low >= 1 && low <= high && high <= 65_535;
        }, 'must be two ports, the lower first'),
    ),
    default: null,
    argument: 'LOW-HIGH',
    help: 'local UDP ports for operators’ connections; any where left out',
  }),
});
