import { type IceServer, iceServerSchema, MAX_SIGNALING_BYTES } from '@farpoint/protocol';
import { defineOption, defineProgram, type OptionValues, schema } from '@farpoint/service';
import * as z from 'zod';
import manifest from '../package.json' with { type: 'json' };

const iceServers = z.preprocess((value, context) => {
  if (typeof value !== 'string') return value;
  try {
    return JSON.parse(value);
  } catch {
    context.addIssue({ code: 'custom', message: 'must be a list of RTCIceServer, as JSON' });
    return z.NEVER;
  }
}, z.array(iceServerSchema)) as z.ZodType<IceServer[]>;

const count = schema.integer({ min: 1 });

export const program = defineProgram({
  name: 'farpoint-signaling',
  summary: 'Introduces robots and operators: Farpoint sessions, and the signaling of the reference system.',
  version: manifest.version,
  section: 'signaling',
  options: {
    host: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      help: 'address to listen on; 0.0.0.0 or :: for all',
    }),
    port: defineOption({
      schema: schema.port(),
      default: 3000,
      argument: 'PORT',
      help: 'for /robot, /operator, /healthz, /metrics and the web app; 0 takes a free one, here and below',
    }),
    reference: defineOption({
      schema: schema.boolean(),
      default: true,
      help: "do not serve the reference system's protocol",
    }),
    referenceRobotPort: defineOption({
      schema: schema.port(),
      default: 3001,
      argument: 'PORT',
      help: 'for robots of the reference system',
    }),
    referenceClientPort: defineOption({
      schema: schema.port(),
      default: 3002,
      argument: 'PORT',
      help: 'for clients of the reference system',
    }),
    referenceOpen: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'ask for no tokens on the ports of the reference system, even where tokens are set',
    }),
    webRoot: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'DIR',
      help: 'serve the built web app from this folder',
    }),
    tlsCert: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'certificate chain (PEM): HTTPS and WSS on every port; read again at SIGHUP',
    }),
    tlsKey: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'private key (PEM)',
    }),
    robotTokens: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'only robots with one of these tokens (YAML or JSON: robot id to token; or a list for any id); read again at SIGHUP',
    }),
    operatorTokens: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'only operators with one of these tokens (YAML or JSON: a list, or name to token); read again at SIGHUP',
    }),
    allowedOrigins: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'ORIGIN,…',
      help: 'only pages of these origins, e.g. https://teleop.example; programs without an origin may come in (default: any)',
    }),
    trustProxy: defineOption({
      schema: schema.boolean(),
      default: false,
      help: "take the peer's address from X-Forwarded-For: only behind a proxy that sets it",
    }),
    iceServers: defineOption({
      schema: iceServers,
      default: [],
      argument: 'JSON',
      help: 'RTCIceServer list given to both peers, e.g. [{"urls":"stun:stun.example:3478"}]',
      secret: true,
    }),
    turnUrls: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'URL,…',
      help: 'TURN servers that share --turn-secret with us (coturn: use-auth-secret)',
    }),
    turnSecret: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'SECRET',
      help: 'makes credentials for --turn-urls; better set by environment or file than by flag',
      secret: true,
    }),
    turnTtlSeconds: defineOption({
      schema: schema.integer({ min: 60 }),
      default: 86_400,
      argument: 'S',
      help: 'how long those credentials hold',
    }),
    maxConnections: defineOption({
      schema: count,
      default: 10_000,
      argument: 'N',
      help: 'WebSockets on all ports together',
    }),
    maxConnectionsPerAddress: defineOption({
      schema: count,
      default: 256,
      argument: 'N',
      help: 'WebSockets from one IPv4 address or one IPv6 /64',
    }),
    maxRobots: defineOption({
      // A list of them, each with the longest id and name, must fit what operators accept (1 MiB).
      schema: schema.integer({ min: 1, max: 4900 }),
      default: 4000,
      argument: 'N',
      help: 'robots, of each protocol',
    }),
    maxSessionsPerOperator: defineOption({
      schema: count,
      default: 16,
      argument: 'N',
      help: 'sessions an operator may have',
    }),
    maxSessionsPerRobot: defineOption({
      schema: count,
      default: 16,
      argument: 'N',
      help: 'sessions a robot may have',
    }),
    maxMessageBytes: defineOption({
      schema: schema.integer({ min: 1024, max: MAX_SIGNALING_BYTES }),
      default: MAX_SIGNALING_BYTES,
      argument: 'BYTES',
      help: 'longest accepted message',
    }),
    messagesPerSecond: defineOption({
      schema: schema.number({ min: 1 }),
      default: 50,
      argument: 'N',
      help: 'messages a peer may send, in the long run',
    }),
    messageBurst: defineOption({
      schema: count,
      default: 200,
      argument: 'N',
      help: 'messages a peer may send at once',
    }),
    maxFaults: defineOption({
      schema: count,
      default: 50,
      argument: 'N',
      help: 'so many refused messages and the peer is disconnected',
    }),
    maxBacklogBytes: defineOption({
      schema: schema.integer({ min: 65_536 }),
      default: 4_194_304,
      argument: 'BYTES',
      help: 'so many bytes waiting for a peer that does not read, and it is disconnected',
    }),
    helloTimeoutMs: defineOption({
      schema: count,
      default: 10_000,
      argument: 'MS',
      help: 'how long a peer may take to say who it is',
    }),
    heartbeatMs: defineOption({
      schema: schema.integer({ min: 100 }),
      default: 5000,
      argument: 'MS',
      help: 'time between pings; a peer that does not answer one before the next is disconnected',
    }),
    listIntervalMs: defineOption({
      schema: count,
      default: 100,
      argument: 'MS',
      help: 'least time between two updates of an operator’s list of robots',
    }),
    listBytesPerSecond: defineOption({
      schema: schema.integer({ min: 100_000 }),
      default: 20_000_000,
      argument: 'BYTES',
      help: 'what the lists of robots and their updates to all operators may take of the network',
    }),
    shutdownMs: defineOption({
      schema: count,
      default: 2000,
      argument: 'MS',
      help: 'how long peers may take to hang up at shutdown',
    }),
  },
});

export type SignalingOptions = OptionValues<typeof program.options>;

/** Every option at its default. */
export function defaultOptions(): SignalingOptions {
  return Object.fromEntries(
    Object.entries(program.options).map(([key, spec]) => [key, spec.default]),
  ) as SignalingOptions;
}
