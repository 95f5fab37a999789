/**
 * The domain's configuration: our defaults, then the options, then `CYCLONEDDS_URI`; later ones take precedence.
 * Source: the configuration reference of CycloneDDS 0.10.
 */
import { RosFault } from '@farpoint/ros';
import * as z from 'zod';

/** RTPS has no port numbers for higher domains. */
export const MOST_DOMAIN = 232;
/** Larger messages are refused unread. This is a cloud of 4 million points at 16 bytes. */
export const MOST_MESSAGE_BYTES = 64 * 1024 * 1024;

const domainSchema = z
  .int('must be a whole number')
  .min(0, 'must be at least 0')
  .max(MOST_DOMAIN, `must be at most ${MOST_DOMAIN}`);
/** A machine to search for if multicast does not reach it. */
export const machineSchema = z
  .string('must be text')
  .regex(/^[A-Za-z0-9_.:[\]-]{1,255}$/, 'must be the name or the address of a machine');
const machinesSchema = z.array(machineSchema).max(64, 'must be at most 64 machines');
/** A network interface, by name or address. */
export const interfaceSchema = z
  .string('must be text')
  .regex(/^[A-Za-z0-9_.:@-]{1,64}$/, 'must be the name or the address of a network interface');

const ddsOptions = z.strictObject({
  /** DDS domain; 0 by default. */
  domain: domainSchema.optional(),
  /** Network interface, by name or address; by default, CycloneDDS chooses one. */
  interface: interfaceSchema.optional(),
  /** Machines to search for that multicast does not reach: names or addresses. */
  peers: machinesSchema.optional(),
  /** Communicates only within this machine. */
  localhostOnly: z.boolean('must be true or false').optional(),
});
export type DdsOptions = z.infer<typeof ddsOptions>;

/** The corresponding environment variables of ROS 2. */
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
 * The options, completed from the environment.
 *
 * @throws {RosFault} `unavailable`, naming the invalid value
 */
export function ddsOptionsFrom(given: unknown, env: Environment): DdsOptions {
  // An empty variable counts as unset.
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

/** @param uri `CYCLONEDDS_URI`: fragments and files that take precedence */
export function cycloneConfiguration(options: DdsOptions, uri = ''): string {
  const { interface: network, localhostOnly, peers = [] } = options;
  const looked = localhostOnly ? ['localhost', ...peers] : peers;
  const general: string[] = [];
  if (localhostOnly) {
    // The loopback interface does not report multicast capability, but has it.
    general.push('<Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>');
  } else if (network !== undefined) {
    const by = /^[0-9.]+$|:/.test(network) ? 'address' : 'name';
    general.push(`<Interfaces><NetworkInterface ${by}="${network}"/></Interfaces>`);
  }
  // Peers are found by address and by the ports that belong to the domain.
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
    // A cloud arrives as one burst of packets. The kernel grants at most net.core.rmem_max.
    '<Internal><SocketReceiveBufferSize min="default" max="16MB"/>',
    `<MaxSampleSize>${MOST_MESSAGE_BYTES}B</MaxSampleSize></Internal>`,
    // Errors go to our log. By default, CycloneDDS opens a file in the working directory, and fails if it is not
    // writable.
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
