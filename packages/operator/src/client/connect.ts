import { decodeTicket } from '@farpoint/grants';
import { type CloudFormat, displayNameSchema, robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { knownInMemory } from '../access/known-robots.ts';
import { type OperatorCredentials, readTicket } from '../access/operator-credentials.ts';
import { transformSupport } from '../peer/encoded-transform.ts';
import { isPrivateAddress, parseSignalingUrl } from '../signaling/signaling-url.ts';
import { RobotClient } from './robot-client.ts';

/** What {@link connect} needs to know. */
export interface ConnectOptions {
  /** Address of the signaling service, e.g. `wss://robots.example.org`. */
  signaling: string;
  /** Id of the robot to connect to. Without it, choose one from the `robots` event with {@link RobotClient.choose}. */
  robot?: string | undefined;
  /** The operator's token, if the service requires one. */
  token?: string | undefined;
  /** A ticket from whoever issues grants: a secret. For robots that admit only operators with a grant. */
  ticket?: string | undefined;
  /** Instead of a ticket: grants with keys of the operator's own, see {@link OperatorCredentials}. */
  credentials?: (() => Promise<readonly OperatorCredentials[]>) | undefined;
  /** Thumbprints of robots' keys, by robot id: a robot that proves no such key is refused. */
  robotKeys?: Readonly<Record<string, string>> | undefined;
  /** The name by which other operators and the robot's log know this one; default: `Operator`. */
  name?: string | undefined;
  /** `relay`: through TURN servers only. */
  icePolicy?: RTCIceTransportPolicy | undefined;
  /** The cloud formats that the robot may choose from; default: all. */
  cloudFormats?: readonly CloudFormat[] | undefined;
}

/** Why {@link connect} cannot begin. */
export type ConnectFailure =
  | 'bad-signaling-address'
  | 'bad-robot-id'
  | 'bad-token'
  | 'bad-ticket'
  /** The address is not encrypted. */
  | 'token-unprotected'
  | 'bad-name'
  /** This browser has none. */
  | 'no-webrtc'
  /** This browser cannot hand encoded frames to a worker. */
  | 'no-encoded-transform';

/** Thrown by {@link connect}. The message says what is wrong. */
export class ConnectError extends Error {
  /** Identifies the class where `instanceof` cannot. */
  override readonly name = 'ConnectError';
  /** What is wrong, for programs. */
  readonly reason: ConnectFailure;

  constructor(reason: ConnectFailure, message: string) {
    super(message);
    this.reason = reason;
  }
}

/** Checks the options of {@link connect}. @throws {ConnectError} */
export function checkConnectOptions(options: ConnectOptions, securePage: boolean) {
  const { signaling, robot, token, ticket, robotKeys, name = 'Operator' } = options;
  const { credentials, icePolicy = 'all', cloudFormats } = options;
  const address = parseSignalingUrl(signaling, securePage);
  if ('fault' in address) throw new ConnectError('bad-signaling-address', `signaling: ${address.fault}`);
  if (robot !== undefined && !robotIdSchema.safeParse(robot).success)
    throw new ConnectError('bad-robot-id', `robot: “${robot}” is not a robot's id`);
  if (token !== undefined && !tokenSchema.safeParse(token).success)
    throw new ConnectError('bad-token', 'token: not an operator’s token; use printable characters only');
  if (token !== undefined && !isPrivateAddress(address.url))
    throw new ConnectError(
      'token-unprotected',
      'token: it is sent to a wss: address only, or within this machine',
    );
  if (ticket !== undefined && decodeTicket(ticket.trim()) === null)
    throw new ConnectError(
      'bad-ticket',
      'ticket: not a ticket; paste the whole line that begins with farpoint-ticket',
    );
  if (!displayNameSchema.safeParse(name).success)
    throw new ConnectError('bad-name', `name: “${name}” cannot be shown; use fewer, printable characters`);
  return {
    signalingUrl: address.url,
    robot,
    token,
    name,
    icePolicy,
    cloudFormats,
    credentials: ticket === undefined ? credentials : ofTicket(ticket),
    knownRobots: robotKeys === undefined ? undefined : knownInMemory(robotKeys),
  };
}

function ofTicket(ticket: string): () => Promise<readonly OperatorCredentials[]> {
  const read = readTicket(ticket);
  return async () => {
    const credentials = await read;
    return credentials === null ? [] : [credentials];
  };
}

/**
 * Connects to a robot and keeps the connection: lost paths, sessions and sockets are restored until
 * {@link RobotClient.close} is called. Listeners that are added synchronously miss no event.
 *
 * ```js
 * const robot = connect({ signaling: 'wss://robots.example.org', robot: 'rover-1', token });
 * robot.on('telemetry', ({ pose }) => show(pose));
 * ```
 *
 * @throws {ConnectError} if an option cannot be used, or if this browser lacks something that a session needs
 */
export function connect(options: ConnectOptions): RobotClient {
  const { robot, ...checked } = checkConnectOptions(options, globalThis.location?.protocol === 'https:');
  if (typeof RTCPeerConnection === 'undefined')
    throw new ConnectError('no-webrtc', 'this browser has no WebRTC: use a current Chrome, Edge or Safari');
  const transform = transformSupport();
  if (transform === 'none') {
    const text = 'this browser lacks encoded transforms (RTCRtpScriptTransform): update it';
    throw new ConnectError('no-encoded-transform', text);
  }
  const client = new RobotClient({ ...checked, transform });
  queueMicrotask(() => {
    client.start();
    if (robot !== undefined && client.chosenRobotId === null) client.choose(robot);
  });
  return client;
}
