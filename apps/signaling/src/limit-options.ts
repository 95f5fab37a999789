/** How much peers may ask of the service. */
import { MAX_SIGNALING_BYTES } from '@farpoint/protocol';
import { defineOption, type OptionTable, schema } from '@farpoint/service';

const count = schema.integer({ min: 1 });

export const limitOptions = {
  maxConnections: defineOption({
    schema: count,
    default: 10_000,
    argument: 'N',
    help: 'maximum WebSockets on all ports together',
  }),
  maxConnectionsPerAddress: defineOption({
    schema: count,
    default: 256,
    argument: 'N',
    help: 'maximum WebSockets from one IPv4 address or one IPv6 /64',
  }),
  maxRobots: defineOption({
    // A list of this many robots, each with the longest id, name and status, must fit into what operators accept (3 MiB).
    schema: schema.integer({ min: 1, max: 4900 }),
    default: 4000,
    argument: 'N',
    help: 'maximum robots of each protocol',
  }),
  maxSessionsPerOperator: defineOption({
    schema: count,
    default: 16,
    argument: 'N',
    help: 'maximum sessions of an operator',
  }),
  maxSessionsPerRobot: defineOption({
    schema: count,
    default: 16,
    argument: 'N',
    help: 'maximum sessions of a robot',
  }),
  maxMessageBytes: defineOption({
    schema: schema.integer({ min: 1024, max: MAX_SIGNALING_BYTES }),
    default: MAX_SIGNALING_BYTES,
    argument: 'BYTES',
    help: 'maximum length of a message',
  }),
  messagesPerSecond: defineOption({
    schema: schema.number({ min: 1 }),
    default: 50,
    argument: 'N',
    help: 'maximum messages a second from a peer, on average',
  }),
  messageBurst: defineOption({
    schema: count,
    default: 200,
    argument: 'N',
    help: 'maximum messages from a peer in one burst',
  }),
  relayBytesPerSecond: defineOption({
    schema: schema.integer({ min: 16_384 }),
    default: 250_000,
    argument: 'BYTES',
    help: 'maximum bytes a second that are passed on to a robot from all operators together, and to an operator, on average; an operator may use a quarter of it',
  }),
  relayMessagesPerSecond: defineOption({
    schema: schema.number({ min: 4 }),
    default: 200,
    argument: 'N',
    help: 'the same in messages a second',
  }),
  maxFaults: defineOption({
    schema: count,
    default: 50,
    argument: 'N',
    help: 'disconnect a peer after this many refused messages',
  }),
  maxBacklogBytes: defineOption({
    schema: schema.integer({ min: 65_536 }),
    default: 4_194_304,
    argument: 'BYTES',
    help: 'disconnect a peer that does not read when this many bytes are waiting for it',
  }),
  helloTimeoutMs: defineOption({
    schema: count,
    default: 10_000,
    argument: 'MS',
    help: 'how long a peer may take to identify itself',
  }),
  heartbeatMs: defineOption({
    schema: schema.integer({ min: 100 }),
    default: 5000,
    argument: 'MS',
    help: 'interval between pings; a peer that does not answer one before the next is disconnected',
  }),
  listIntervalMs: defineOption({
    schema: count,
    default: 100,
    argument: 'MS',
    help: 'minimum interval between two updates of an operator’s list of robots',
  }),
  listBytesPerSecond: defineOption({
    schema: schema.integer({ min: 100_000 }),
    default: 20_000_000,
    argument: 'BYTES',
    help: 'maximum network rate of the robot lists and their updates, for all operators together',
  }),
} satisfies OptionTable;
