/** Whether the implementation can be reached at all: if not, that is no fault of its protocol. */
import { get as getHttp } from 'node:http';
import { get as getHttps } from 'node:https';
import { WebSocket } from 'ws';

/** Addresses by the option that sets them. */
export type Addresses = Readonly<Record<string, string>>;

/** The implementation cannot be reached; says where, why and what to check. */
export class UnreachableError extends Error {
  override readonly name = 'UnreachableError';
}

const ANSWERS_WITHIN_MS = 10_000;

/** The first address at which no WebSocket can be opened; `null` if there is none. */
export async function findUnreachable(addresses: Addresses): Promise<UnreachableError | null> {
  for (const [option, url] of Object.entries(addresses)) {
    const error = await openFault(url);
    if (error !== null) return unreachable(`${url} (--${option}) cannot be reached`, error);
  }
  return null;
}

/**
 * The first address at which nobody is any more. Opens no WebSocket: for the released signaling, only the client that
 * connected last counts, and that is a peer of the suite.
 *
 * @param since the case after which this is asked
 */
export async function findGone(addresses: Addresses, since: string): Promise<UnreachableError | null> {
  for (const [option, url] of Object.entries(addresses)) {
    const error = await answerFault(url);
    if (error !== null) return unreachable(`${url} (--${option}) went away during ‘${since}’`, error);
  }
  return null;
}

function openFault(url: string): Promise<Error | null> {
  return new Promise((resolve) => {
    const socket = new WebSocket(url, { handshakeTimeout: ANSWERS_WITHIN_MS });
    socket.on('error', (error) => resolve(error));
    socket.on('open', () => {
      socket.on('close', () => resolve(null));
      socket.terminate();
    });
  });
}

/** Statuses with which a proxy says that there is nobody behind it. */
const NOBODY_BEHIND = [502, 503, 504];

function answerFault(url: string): Promise<Error | null> {
  return new Promise((resolve) => {
    const get = url.startsWith('wss:') ? getHttps : getHttp;
    const request = get(url.replace(/^ws/, 'http'), { agent: false, timeout: ANSWERS_WITHIN_MS });
    const end = (error: Error | null) => {
      resolve(error);
      request.destroy();
    };
    request.on('response', ({ statusCode = 0 }) =>
      end(NOBODY_BEHIND.includes(statusCode) ? new Error(`Unexpected server response: ${statusCode}`) : null),
    );
    request.on('timeout', () => end(request.socket?.connecting === false ? null : new Error('timed out')));
    // Whoever hangs up at a request that is not for a WebSocket is there.
    request.on('error', (error) => end(/^(ECONNRESET|EPIPE|HPE_.*)$/.test(codeOf(error)) ? null : error));
  });
}

function unreachable(what: string, error: Error): UnreachableError {
  const { why, check } = reason(codeOf(error), error.message);
  return new UnreachableError(`${what}: ${why}; check ${check}`);
}

function codeOf(error: Error): string {
  return (error as NodeJS.ErrnoException).code ?? '';
}

/** @param code Node's, or an empty string */
export function reason(code: string, message: string): { why: string; check: string } {
  const detail = message || code;
  if (code === 'ECONNREFUSED')
    return { why: 'nothing listens there', check: 'that the program runs, and the host and port' };
  if (/^(ENOTFOUND|EAI_AGAIN)$/.test(code))
    return { why: 'there is no host of that name', check: 'the name, and this machine’s name resolution' };
  if (/^(EHOSTUNREACH|ENETUNREACH|ETIMEDOUT)$/.test(code) || /timed out/.test(detail))
    return { why: 'nobody answers', check: 'the network path: routes, VPN, firewalls' };
  if (/CERT|SIGNED|SIGNATURE|ISSUER/.test(code))
    return {
      why: `its certificate is not accepted (${detail})`,
      check: 'the host name, the certificate’s dates, and NODE_EXTRA_CA_CERTS for an authority of your own',
    };
  if (/EPROTO|SSL|TLS/.test(code))
    return {
      why: 'it does not speak TLS',
      check: 'whether the address should begin with ws:// instead of wss://',
    };
  const status = /server response: (\d+)/.exec(detail)?.[1];
  if (status !== undefined)
    return {
      why: `it answers with HTTP status ${status}, and opens no WebSocket`,
      check: 'host, port and path, and the proxy if there is one',
    };
  return {
    why: `what listens there is no WebSocket server (${detail})`,
    check: 'host and port, and whether the address should begin with wss:// instead of ws://',
  };
}
