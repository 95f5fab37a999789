import type { IncomingMessage } from 'node:http';
import { isIP, isIPv4 } from 'node:net';

/** The host that an address stands for: an IPv4 address, or the /64 prefix that a single IPv6 host usually has. */
export function addressKey(address: string): string {
  if (isIPv4(address)) return address;
  const [head = '', tail] = address.split('::', 2);
  const groups = head === '' ? [] : head.split(':');
  if (tail !== undefined) {
    const after = tail === '' ? [] : tail.split(':');
    while (groups.length + after.length < 8) groups.push('0');
    groups.push(...after);
  }
  return `${groups.slice(0, 4).join(':')}::/64`;
}

/**
 * Who asks: the socket's address or, if that is a trusted proxy, the last address of `X-Forwarded-For` that is none. What
 * stands before that one, anybody may have written.
 */
export function peerAddress(request: IncomingMessage, proxies: { has(address: string): boolean }): string {
  let address = plainAddress(request.socket.remoteAddress ?? 'unknown');
  const forwarded = request.headers['x-forwarded-for'];
  const hops = [forwarded ?? []].flat().flatMap((each) => each.split(','));
  while (proxies.has(address)) {
    const before = hops.pop();
    // What is no address counts for the proxy that said it: all such requests together.
    const read = before === undefined ? null : forwardedAddress(before);
    if (read === null) return address;
    address = read;
  }
  return address;
}

/**
 * An address as proxies write it: some add the port (`203.0.113.10:4711`, `[2001:db8::1]:443`), which is another for each
 * connection. @returns `null` if it is none
 */
export function forwardedAddress(text: string): string | null {
  const trimmed = text.trim().replace(/^"(.*)"$/, '$1');
  const [, bracketed] = /^\[([^\]]+)\](?::\d{1,5})?$/.exec(trimmed) ?? [];
  const [, beforePort] = /^([\d.]+):\d{1,5}$/.exec(trimmed) ?? [];
  const address = plainAddress(bracketed ?? beforePort ?? trimmed);
  return isIP(address) === 0 ? null : address;
}

/** An address in the one way in which it counts and is logged: IPv4 as such, not as a part of IPv6, and IPv6 at its shortest. */
export function plainAddress(address: string): string {
  const [bare = address] = address.split('%', 1);
  if (isIP(bare) !== 6) return bare;
  const written = URL.parse(`http://[${bare}]/`)?.hostname.slice(1, -1) ?? bare;
  const [, high, low] = /^::ffff:([0-9a-f]{1,4}):([0-9a-f]{1,4})$/.exec(written) ?? [];
  if (high === undefined || low === undefined) return written;
  const [first, second] = [Number.parseInt(high, 16), Number.parseInt(low, 16)];
  return [first >> 8, first & 255, second >> 8, second & 255].join('.');
}
