/** Asks STUN and TURN servers for what an operator's connection will need from them. */
import type { IceServer } from '@farpoint/protocol';
import { classes, createTurnClient, Message, methods, parseIceServers, StunProtocol } from 'werift';

/** One address of an ICE server. */
export interface IceTarget {
  url: string;
  username: string;
  credential: string;
}

export type IceAnswer =
  /** `mapped`: our address as the server sees it; `relayed`: the address that a TURN server allocates for us. */
  | { outcome: 'answered'; mapped: string | null; relayed: string | null; milliseconds: number }
  | { outcome: 'silent' }
  /** `status`: STUN's error code, e.g. 401; `null` if the refusal does not come from STUN. */
  | { outcome: 'refused'; status: number | null; detail: string }
  /** The address cannot be used. */
  | { outcome: 'unusable'; detail: string };

/** One target per address. */
export function iceTargets(servers: readonly IceServer[]): IceTarget[] {
  return servers.flatMap(({ urls, username = '', credential = '' }) =>
    (Array.isArray(urls) ? urls : [urls]).map((url) => ({ url, username, credential })),
  );
}

/**
 * Requests a binding from a STUN server or an allocation from a TURN server, with the robot's own ICE stack. Never
 * throws.
 */
export async function probeIce(target: IceTarget, withinMs: number, now: () => number): Promise<IceAnswer> {
  const { url, username, credential } = target;
  const {
    stunServer,
    turnServer,
    turnTransport = 'udp',
  } = parseIceServers([{ urls: url, username, credential }]);
  const begin = now();
  if (turnServer !== undefined) {
    // The stack drops a server's second refusal because it is not signed with a key. A separate request tells whether
    // the server is alive.
    const greeted =
      turnTransport === 'udp' ? await within(withinMs, request(turnServer, methods.ALLOCATE)) : null;
    if (greeted?.outcome === 'silent') return greeted;
    if (greeted?.outcome === 'refused' && greeted.status !== 401) return greeted;
    const answer = await within(withinMs, allocate(turnServer, turnTransport, target, withinMs));
    if (answer.outcome === 'silent' && greeted !== null)
      return { outcome: 'refused', status: 401, detail: 'it does not accept the user name and credential' };
    return answer.outcome === 'answered' ? { ...answer, milliseconds: now() - begin } : answer;
  }
  if (stunServer === undefined)
    return { outcome: 'unusable', detail: 'it is not the address of a STUN or TURN server' };
  const answer = await within(withinMs, request(stunServer, methods.BINDING));
  return answer.outcome === 'answered' ? { ...answer, milliseconds: now() - begin } : answer;
}

async function within(milliseconds: number, asked: Promise<IceAnswer>): Promise<IceAnswer> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<IceAnswer>((resolve) => {
    timer = setTimeout(() => resolve({ outcome: 'silent' }), milliseconds);
  });
  const answer = await Promise.race([asked.catch(refusal), late]);
  clearTimeout(timer);
  return answer;
}

async function allocate(
  address: Address,
  transport: 'udp' | 'tcp' | 'tls',
  { username, credential: password }: IceTarget,
  connectTimeoutMs: number,
): Promise<IceAnswer> {
  const client = await createTurnClient({ address, username, password }, { transport, connectTimeoutMs });
  const { mappedAddress, relayedAddress } = client;
  void client.close().catch(() => undefined);
  return { outcome: 'answered', mapped: text(mappedAddress), relayed: text(relayedAddress), milliseconds: 0 };
}

/** One request over UDP, without credentials. */
async function request(server: Address, method: methods): Promise<IceAnswer> {
  const stun = new StunProtocol();
  await stun.connectionMade(true);
  try {
    const message = new Message(method, classes.REQUEST);
    if (method === methods.ALLOCATE) message.setAttribute('REQUESTED-TRANSPORT', UDP_TRANSPORT);
    const [response] = await stun.request(message, server);
    const mapped = response.getAttributeValue('XOR-MAPPED-ADDRESS') as Address | undefined;
    return { outcome: 'answered', mapped: text(mapped), relayed: null, milliseconds: 0 };
  } finally {
    void stun.close().catch(() => undefined);
  }
}

/** Protocol 17 (UDP) in the first byte, as in the REQUESTED-TRANSPORT attribute. */
const UDP_TRANSPORT = 0x11000000;

type Address = readonly [host: string, port: number];

function text(address: Address | undefined): string | null {
  return address === undefined ? null : `${address[0]}:${address[1]}`;
}

function refusal(error: unknown): IceAnswer {
  const response = (error as { response?: unknown }).response;
  const status =
    response instanceof Message ? (response.getAttributeValue('ERROR-CODE') as [number, string]) : null;
  if (status !== null) return { outcome: 'refused', status: status[0], detail: `${status[0]} ${status[1]}` };
  if (error instanceof Error && error.constructor.name === 'TransactionTimeout') return { outcome: 'silent' };
  return { outcome: 'refused', status: null, detail: error instanceof Error ? error.message : String(error) };
}
