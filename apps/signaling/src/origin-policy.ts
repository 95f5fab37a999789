/** Which pages may open a WebSocket. A browser says where the page came from; other programs say nothing. */
import { isLoopbackHost } from '@farpoint/protocol';
import { isOwnHost } from '@farpoint/service';

export interface OriginPolicy {
  /** Besides the service's own; `*` allows every page. */
  readonly allowed: readonly string[];
  /** The service listens on loopback only, and no proxy is in front of it. */
  readonly isLocal: boolean;
  /** The service's own names; `null` with TLS, where the browser has checked the name. */
  readonly ownNames: ReadonlySet<string> | null;
}

/** `host`: the service served it itself, but by a name that is not its own. */
export type OriginVerdict = 'allowed' | 'origin' | 'host';

/**
 * Allows pages that this service served itself, by a name of its own: whoever owns another name can let it point here (DNS
 * rebinding).
 *
 * On a service for this machine alone, pages of this machine's other servers are allowed as well (a development server),
 * and no page under another name.
 *
 * @param origin the header, undefined if there is none
 * @param host the header
 */
export function judgeOrigin(
  origin: string | undefined,
  host: string | undefined,
  { allowed, isLocal, ownNames }: OriginPolicy,
): OriginVerdict {
  if (origin === undefined || allowed.includes('*') || allowed.includes(origin)) return 'allowed';
  const from = URL.parse(origin);
  if (from === null || !/^https?:$/.test(from.protocol)) return 'origin';
  if (isLocal) return isLoopbackName(from.hostname) && isLoopbackName(nameOf(host)) ? 'allowed' : 'origin';
  if (host === undefined || from.host !== withoutDefaultPort(host, from.protocol)) return 'origin';
  return ownNames === null || isOwnHost(host, ownNames) ? 'allowed' : 'host';
}

function isLoopbackName(name: string): boolean {
  return isLoopbackHost(name) || name.endsWith('.localhost');
}

function nameOf(host: string | undefined): string {
  return URL.parse(`http://${host ?? ''}`)?.hostname ?? '';
}

function withoutDefaultPort(host: string, protocol: string): string {
  return URL.parse(`${protocol}//${host}`)?.host ?? '';
}
