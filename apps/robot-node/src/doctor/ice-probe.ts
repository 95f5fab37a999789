/** Asks STUN and TURN servers for what an operator's connection will ask of them. */
import type { IceServer } from '@farpoint/protocol';
import { classes, createTurnClient, Message, methods, parseIceServers, StunProtocol } from 'werift';

/** One address of an ICE server. */
export interface IceTarget {
  url: string;
  username: string;
  credential: string;
}

export type IceAnswer =
  /** `mapped`: what the server sees us as; `relayed`: what it lends us, of TURN. */
  | { outcome: 'answered'; mapped: string | null; relayed: string | null; milliseconds: number }
  | { outcome: 'silent' }
  /** `status` as STUN has it, e.g. 401; `null` where it is not STUN that refuses. */
  | { outcome: 'refused'; status: number | null; detail: string }
  /** Not an address that can be used. */
  | { outcome: 'unusable'; detail: string };

/** One target for each address. */
export function iceTargets(servers: readonly IceServer[]): IceTarget[] {
  return servers.flatMap(({ urls, username = '', credential = '' }) =>
    (Array.isArray(urls) ? urls : [urls]).map((url) => ({ url, username, credential })),
  );
}

/** A binding of a STUN server, an allocation of a TURN server, by the robot's own means. Never throws. */
export async function probeIce(target: IceTarget, withinMs: number, now: () => number): Promise<IceAnswer> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<IceAnswer>((resolve) => {
    timer = setTimeout(() => resolve({ outcome: 'silent' }), withinMs);
  });
  const asked = ask(target, withinMs, now).catch(refusal);
  const answer = await Promise.race([asked, late]);
  clearTimeout(timer);
  return answer;
}

async function ask(
  { url, username, credential }: IceTarget,
  withinMs: number,
  now: () => number,
): Promise<IceAnswer> {
  const { stunServer, turnServer, turnTransport } = parseIceServers([{ urls: url, username, credential }]);
  const begin = now();
  if (turnServer !== undefined) {
    const client = await createTurnClient(
      { address: turnServer, username, password: credential },
      { transport: turnTransport ?? 'udp', connectTimeoutMs: withinMs },
    );
    const { mappedAddress, relayedAddress } = client;
    const milliseconds = now() - begin;
    void client.close().catch(() => undefined);
    return { outcome: 'answered', mapped: text(mappedAddress), relayed: text(relayedAddress), milliseconds };
  }
  if (stunServer === undefined)
    return { outcome: 'unusable', detail: 'it is no address of a STUN or TURN server' };
  const stun = new StunProtocol();
  await stun.connectionMade(true);
  try {
    const [response] = await stun.request(new Message(methods.BINDING, classes.REQUEST), stunServer);
    const mapped = response.getAttributeValue('XOR-MAPPED-ADDRESS') as Address | undefined;
    return { outcome: 'answered', mapped: text(mapped), relayed: null, milliseconds: now() - begin };
  } finally {
    void stun.close().catch(() => undefined);
  }
}

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
