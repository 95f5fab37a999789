/**
 * The names and addresses of local networks: all that the authority may vouch for, by the name constraints of its own
 * certificate (RFC 5280, 4.2.1.10). Whoever installs it on a headset so trusts it with no site of the internet.
 */

/** Private, link-local and loopback: RFC 1918, RFC 3927, RFC 6598; RFC 4193, RFC 4291. */
export const LOCAL_NETWORKS = [
  '10.0.0.0/8',
  '172.16.0.0/12',
  '192.168.0.0/16',
  '169.254.0.0/16',
  '100.64.0.0/10',
  '127.0.0.0/8',
  'fc00::/7',
  'fe80::/10',
  '::1/128',
] as const;

/** Multicast DNS (RFC 6762), home networks (RFC 8375), private use (ICANN), and this machine. */
export const LOCAL_DOMAINS = ['local', 'home.arpa', 'internal', 'localhost'] as const;

const DNS_NAME = /^(?=.{1,253}$)([a-z0-9]([a-z0-9-]{0,61}[a-z0-9])?)(\.[a-z0-9]([a-z0-9-]{0,61}[a-z0-9])?)*$/;

/** Whether a DNS name, in lower case, is one of a local network. */
export function isLocalName(name: string): boolean {
  return (
    DNS_NAME.test(name) && LOCAL_DOMAINS.some((domain) => name === domain || name.endsWith(`.${domain}`))
  );
}
