import { MAX_POINTS_PER_FRAME, POINTS_PER_PACKET } from '@farpoint/protocol';
import { adminOptions, defineOption, defineProgram, type OptionValues, schema } from '@farpoint/service';
import * as z from 'zod';
import manifest from '../package.json' with { type: 'json' };
import type { BridgeOptions } from './bridge.ts';

const bits = schema.number({ min: 10_000, max: 2_000_000_000 });

function port(usual: number, help: string) {
  return defineOption({
    schema: schema.port(),
    default: usual,
    argument: 'PORT',
    help: `${help}; 0 takes a free one`,
  });
}

export const program = defineProgram({
  name: 'farpoint-bridge',
  summary:
    "The reference system's headset-side bridge: connects to its robots by WebRTC and to its web page by local WebSockets.",
  version: manifest.version,
  section: 'bridge',
  options: {
    signaling: defineOption({
      schema: z.url({ protocol: /^wss?$/, error: 'must be a ws:// or wss:// address' }),
      default: 'ws://127.0.0.1:3002',
      argument: 'URL',
      help: 'client port of the signaling service; a page may choose another',
    }),
    host: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      help: "address for the page's sockets; any address but loopback lets others drive",
    }),
    controlPort: port(8085, 'port for the choice of robots'),
    telemetryPort: port(8090, 'port for commands'),
    streamingPort: port(8095, 'port for frames'),
    allowedOrigins: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'ORIGIN,…',
      help: 'origins of web pages that may connect, in addition to those served from this machine',
    }),
    maxRobots: defineOption({
      schema: schema.integer({ min: 1, max: 1000 }),
      default: 100,
      argument: 'N',
      help: 'maximum robots connected at once',
    }),
    maxPoints: defineOption({
      schema: schema.integer({ min: POINTS_PER_PACKET, max: MAX_POINTS_PER_FRAME }),
      default: 500_000,
      argument: 'N',
      help: 'maximum points in a frame; larger frames are refused',
    }),
    reorderMs: defineOption({
      schema: schema.number({ min: 0, max: 1000 }),
      default: 20,
      argument: 'MS',
      help: 'how long an incomplete frame waits for reordered packets',
    }),
    startBitsPerSecond: defineOption({
      schema: bits,
      default: 10_000_000,
      argument: 'BPS',
      help: 'initial rate that a robot may send',
    }),
    maxBitsPerSecond: defineOption({
      schema: bits,
      default: 100_000_000,
      argument: 'BPS',
      help: 'maximum rate that a robot may send',
    }),
    niceness: defineOption({
      schema: schema.integer({ min: -20, max: 19 }),
      default: -5,
      argument: 'N',
      help: 'priority of this process, if the system permits it; packets and commands should not wait for the processor',
    }),
    stats: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'for measurements: write each frame that pages got, one JSON object a line',
    }),
    ...adminOptions(9600),
  },
});

export function toBridgeOptions(options: OptionValues<typeof program.options>): BridgeOptions {
  return options;
}
