/** The program's options. */
import {
  adminOptions,
  defineOption,
  defineProgram,
  type OptionTable,
  type OptionValues,
  schema,
} from '@farpoint/service';
import * as z from 'zod';
import manifest from '../package.json' with { type: 'json' };
import { outages, steps } from './capacity-options.ts';

const ms = schema.number({ min: 0, max: 600_000 });
const probability = schema.number({ min: 0, max: 1 });
const signalingUrl = z.url({ protocol: /^wss?$/, error: 'must be a ws:// or wss:// address' });

/** Options that can be set for both directions at once and for one direction. */
export const directional = {
  rateMbps: {
    schema: schema.optional(schema.number({ min: 0, max: 100_000 })),
    argument: 'MBPS',
    help: 'capacity, 10^6 bit/s on the wire; default: no bottleneck',
  },
  steps: {
    schema: schema.optional(steps),
    argument: 'S:MBPS,…',
    help: 'capacity from each given second on, e.g. 0:41.44,30:8,60:41.44',
  },
  trace: {
    schema: schema.optional(schema.text()),
    argument: 'FILE',
    help: 'capacity over time: a CSV file with time_s,capacity_mbps',
  },
  outages: {
    schema: schema.optional(outages),
    argument: 'S-S,…',
    help: 'spans of seconds without service, e.g. 10-15,30-36',
  },
  delayMs: {
    schema: schema.optional(ms),
    argument: 'MS',
    help: 'propagation delay, one way; default: half of --rtt-ms',
  },
  jitterMs: {
    schema: schema.optional(ms),
    argument: 'MS',
    help: 'random variation of the delay, ± this much (0)',
  },
  loss: {
    schema: schema.optional(probability),
    argument: 'P',
    help: 'share of packets lost independently of each other (0)',
  },
  burstLoss: {
    schema: schema.optional(schema.number({ min: 0, max: 0.9 })),
    argument: 'P',
    help: 'share of packets lost in bursts, by Gilbert’s model (0)',
  },
  burstLength: {
    schema: schema.optional(schema.number({ min: 1, max: 10_000 })),
    argument: 'N',
    help: 'mean length of those bursts, packets (5)',
  },
  reorder: {
    schema: schema.optional(probability),
    argument: 'P',
    help: 'share of packets held back, so that others overtake them (0)',
  },
  reorderMs: {
    schema: schema.optional(ms),
    argument: 'MS',
    help: 'how long those packets are held back (10)',
  },
  duplicate: { schema: schema.optional(probability), argument: 'P', help: 'share of packets duplicated (0)' },
  queueMs: {
    schema: schema.optional(schema.number({ min: 1, max: 600_000 })),
    argument: 'MS',
    help: 'maximum queue at the current capacity (100)',
  },
  queueBytes: {
    schema: schema.optional(schema.integer({ min: 1500, max: 1 << 30 })),
    argument: 'BYTES',
    help: 'maximum queue in bytes, instead of --queue-ms',
  },
  cross: {
    schema: schema.optional(schema.choice(['none', 'cubic', 'reno', 'cbr'])),
    argument: 'KIND',
    help: 'competing flow: cubic or reno (a bulk TCP sender), cbr (constant bit rate), none (none)',
  },
  crossMbps: {
    schema: schema.optional(schema.number({ min: 0.001, max: 100_000 })),
    argument: 'MBPS',
    help: 'rate of a competing cbr flow, 10^6 bit/s (1)',
  },
  crossStart: {
    schema: schema.optional(schema.number({ min: 0 })),
    argument: 'S',
    help: 'when the competing flow starts, in seconds (0)',
  },
} as const;
export type DirectionalKey = keyof typeof directional;

const sides = { up: 'from the robot', down: 'to the robot' } as const;

function directionalOptions(): OptionTable {
  const table: Record<string, OptionTable[string]> = {};
  for (const [key, spec] of Object.entries(directional)) table[key] = { ...spec, default: null };
  for (const [direction, words] of Object.entries(sides)) {
    for (const [key, spec] of Object.entries(directional)) {
      const name = `${direction}${key[0]!.toUpperCase()}${key.slice(1)}`;
      table[name] = {
        ...spec,
        default: null,
        help: `like the option without "${direction}-", but only ${words}`,
      };
    }
  }
  return table;
}

export const program = defineProgram({
  name: 'farpoint-link',
  summary:
    'Puts a bad network between a robot and its operators: a signaling proxy that routes all their packets through an emulated link. Point the robot at it.',
  version: manifest.version,
  section: 'link',
  options: {
    signaling: defineOption({
      schema: signalingUrl,
      default: 'ws://127.0.0.1:3000',
      argument: 'URL',
      help: 'address of the real signaling service',
    }),
    host: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      help: 'address to listen on; it also stands in for the addresses of peers on other machines',
    }),
    port: defineOption({
      schema: schema.port(),
      default: 3100,
      argument: 'PORT',
      help: 'port at which robots (or operators) find their signaling; 0 takes a free one',
    }),
    referenceRobots: defineOption({
      schema: schema.optional(signalingUrl),
      default: null,
      argument: 'URL',
      help: 'robot port of the reference protocol, e.g. ws://127.0.0.1:3001; served on --port + 1',
    }),
    referenceClients: defineOption({
      schema: schema.optional(signalingUrl),
      default: null,
      argument: 'URL',
      help: 'client port of the reference protocol, e.g. ws://127.0.0.1:3002; served on --port + 2',
    }),
    rttMs: defineOption({
      schema: ms,
      default: 0,
      argument: 'MS',
      help: 'propagation delay, both ways together',
    }),
    seed: defineOption({
      schema: schema.integer({ min: 0, max: 0x7fffffff }),
      default: 1,
      argument: 'N',
      help: 'seed of all random numbers',
    }),
    traceEnd: defineOption({
      schema: schema.choice(['loop', 'hold']),
      default: 'loop',
      argument: 'KIND',
      help: 'after the last sample of a trace: loop from the start, or hold the last capacity',
    }),
    jitterReorders: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'let jitter reorder packets; otherwise their order is kept',
    }),
    stats: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'write statistics every 100 ms to this file, one JSON object a line',
    }),
    niceness: defineOption({
      schema: schema.integer({ min: -20, max: 19 }),
      default: -10,
      argument: 'N',
      help: 'priority of this process, if the system permits it; waiting for the processor would distort the link',
    }),
    ...adminOptions(9500),
    ...(directionalOptions() as Directional),
  },
});

type Optional<T> = { [Key in keyof T]: T[Key] extends { schema: infer Schema } ? { schema: Schema } : never };
type Directional = {
  [Key in DirectionalKey]: OptionTable[string] & Optional<typeof directional>[Key];
};
export type LinkOptions = OptionValues<typeof program.options>;
