/** Which pages may open a WebSocket. A browser says where the page came from; other programs say nothing. */
import { isLoopbackHost } from '@farpoint/protocol';

export interface OriginPolicy {
  /** Besides the service's own; `*` allows every page. */
  readonly allowed: readonly string[];
  /** The service listens on loopback only, and no proxy is in front of it. */
  readonly isLocal: boolean;
}

/**
 * Allows pages that this service served itself, by the name that the browser knows it by.
 *
 * On a service for this machine alone, pages of this machine's other servers are allowed as well (a development server),
 * and no page under another name: whoever owns a name can let it point to 127.0.0.1 (DNS rebinding).
 *
 * @param origin the header, undefined if there is none
 * @param host the header
 */
export function isOriginAllowed(
  origin: string | undefined,
  host: string | undefined,
  { allowed, isLocal }: OriginPolicy,
): boolean {
  if (origin === undefined || allowed.includes('*') || allowed.includes(origin)) return true;
  const from = URL.parse(origin);
  if (from === null || !/^https?:$/.test(from.protocol)) return false;
  if (isLocal) return isLoopbackName(from.hostname) && isLoopbackName(nameOf(host));
  return host !== undefined && from.host === withoutDefaultPort(host, from.protocol);
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
