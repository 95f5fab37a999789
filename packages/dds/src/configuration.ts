/**
 * What the domain is configured with: our defaults, then the options, then `CYCLONEDDS_URI`, the later winning. Source: the configuration reference of
 * CycloneDDS 0.10.
 */
import { RosFault } from '@farpoint/ros';
import * as z from 'zod';

/** Port numbers of RTPS end there. */
export const MOST_DOMAIN = 232;
/** Larger messages are refused unread: a cloud of 4 million points at 16 bytes. */
export const MOST_MESSAGE_BYTES = 64 * 1024 * 1024;

const domainSchema = z
  .int('must be a whole number')
  .min(0, 'must be at least 0')
  .max(MOST_DOMAIN, `must be at most ${MOST_DOMAIN}`);
/** A machine to look for where multicast does not reach. */
export const machineSchema = z
  .string('must be text')
  .regex(/^[A-Za-z0-9_.:[\]-]{1,255}$/, 'must be the name or the address of a machine');
const machinesSchema = z.array(machineSchema).max(64, 'must be at most 64 machines');
/** A network interface, by name or address. */
export const interfaceSchema = z
  .string('must be text')
  .regex(/^[A-Za-z0-9_.:@-]{1,64}$/, 'must be the name or the address of a network interface');

const ddsOptions = z.strictObject({
  /** DDS domain; 0 where not given. */
  domain: domainSchema.optional(),
  /** Network interface, by name or address; left out: CycloneDDS chooses one. */
  interface: interfaceSchema.optional(),
  /** Machines to look for where multicast does not reach: names or addresses. */
  peers: machinesSchema.optional(),
  /** Nothing leaves this machine, and nothing comes in. */
  localhostOnly: z.boolean('must be true or false').optional(),
});
export type DdsOptions = z.infer<typeof ddsOptions>;

/** The environment variables of ROS 2 that say the same. */
const environment = z.object({
  ROS_DOMAIN_ID: z.coerce.number().pipe(domainSchema).optional(),
  ROS_LOCALHOST_ONLY: z.enum(['0', '1'], 'must be 0 or 1').optional(),
  ROS_AUTOMATIC_DISCOVERY_RANGE: z
    .enum(
      ['SUBNET', 'LOCALHOST', 'OFF', 'SYSTEM_DEFAULT'],
      'must be SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT',
    )
    .optional(),
  ROS_STATIC_PEERS: z
    .string()
    .transform((list) => list.split(';').filter((peer) => peer !== ''))
    .pipe(machinesSchema)
    .optional(),
});

type Environment = Readonly<Record<string, string | undefined>>;

/**
 * The options, filled up from the environment.
 * @throws {RosFault} `unavailable`, naming what cannot be
 */
export function ddsOptionsFrom(given: unknown, env: Environment): DdsOptions {
  // A variable that is set to nothing is not set.
  const set = Object.fromEntries(Object.entries(env).filter(([, value]) => value !== ''));
  const ros = parse(environment, set);
  const local = ros.ROS_LOCALHOST_ONLY === '1' || ros.ROS_AUTOMATIC_DISCOVERY_RANGE === 'LOCALHOST';
  const { domain, interface: network, peers, localhostOnly } = parse(ddsOptions, given);
  const staticPeers = ros.ROS_STATIC_PEERS;
  return {
    domain: domain ?? ros.ROS_DOMAIN_ID ?? 0,
    localhostOnly: localhostOnly ?? (network === undefined && local),
    ...(network === undefined ? {} : { interface: network }),
    ...((peers ?? staticPeers) === undefined ? {} : { peers: peers ?? staticPeers }),
  };
}

/** @param uri `CYCLONEDDS_URI`: fragments and files that have the last word */
export function cycloneConfiguration(options: DdsOptions, uri = ''): string {
  const { interface: network, localhostOnly, peers = [] } = options;
  const looked = localhostOnly ? ['localhost', ...peers] : peers;
  const general: string[] = [];
  if (localhostOnly) {
    // The loopback does not call itself capable of multicast, and is.
    general.push('<Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>');
  } else if (network !== undefined) {
    const by = /^[0-9.]+$|:/.test(network) ? 'address' : 'name';
    general.push(`<Interfaces><NetworkInterface ${by}="${network}"/></Interfaces>`);
  }
  // Where peers are looked for by address, they find us by the ports that belong to the domain.
  const discovery =
    looked.length === 0
      ? ''
      : `<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex><Peers>${looked
          .map((peer) => `<Peer Address="${peer}"/>`)
          .join('')}</Peers>`;
  const ours = [
    '<CycloneDDS><Domain Id="any">',
    `<General>${general.join('')}</General>`,
    `<Discovery>${discovery}</Discovery>`,
    // A cloud comes as one burst of packets. The kernel gives as much as net.core.rmem_max allows.
    '<Internal><SocketReceiveBufferSize min="default" max="16MB"/>',
    `<MaxSampleSize>${MOST_MESSAGE_BYTES}B</MaxSampleSize></Internal>`,
    // Its errors come to the log. Left to itself it opens a file in the working directory, or fails where it may not.
    '<Tracing><Verbosity>severe</Verbosity><OutputFile>/dev/null</OutputFile></Tracing>',
    '</Domain></CycloneDDS>',
  ].join('');
  return uri === '' ? ours : `${ours},${uri}`;
}

function parse<T>(schema: z.ZodType<T>, value: unknown): T {
  const result = schema.safeParse(value);
  if (result.success) return result.data;
  const faults = result.error.issues.map(({ path, message }) => `${path.join('.')} ${message}`);
  throw new RosFault('unavailable', `DDS: ${faults.join('; ')}`);
}
