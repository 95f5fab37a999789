import type { IncomingMessage } from 'node:http';
import { isIPv4 } from 'node:net';

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

/** The peer's address: the socket's, or the one that the last proxy before us saw. */
export function peerAddress(request: IncomingMessage, trustProxy: boolean): string {
  const forwarded = request.headers['x-forwarded-for'];
  const last = typeof forwarded === 'string' ? forwarded.split(',').at(-1)?.trim() : undefined;
  const address = (trustProxy && last ? last : request.socket.remoteAddress) ?? 'unknown';
  return plainAddress(address);
}

/** An address as it is written in the log: IPv4 as such, not as a part of IPv6. */
export function plainAddress(address: string): string {
  return address.replace(/^::ffff:(?=\d+\.)/, '');
}
