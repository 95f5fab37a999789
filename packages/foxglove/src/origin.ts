/**
 * Web pages that may connect. A browser lets any page open a socket to this machine, so without this check every page
 * that somebody visits could watch through the robot's cameras.
 */
import { isIP } from 'node:net';

const OWN_HOSTS: readonly string[] = ['localhost', '127.0.0.1', '[::1]'];
/** Foxglove in the browser, and viewers installed as programs, whose pages are files. */
const VIEWERS: readonly string[] = ['https://app.foxglove.dev', 'https://studio.foxglove.dev', 'file://'];

/**
 * Pages of this machine may connect only by an address or name of the robot: whoever owns another name can let it point
 * here (DNS rebinding).
 *
 * @param origin as the browser says; programs need not say any
 * @param host by which name it asks
 * @param ownNames of the robot
 */
export function isAllowedOrigin(
  origin: string | undefined,
  host: string | undefined,
  { allowedOrigins: allowed, ownNames }: { allowedOrigins: readonly string[]; ownNames: readonly string[] },
): boolean {
  if (origin === undefined || VIEWERS.includes(origin)) return true;
  if (allowed.includes('*') || allowed.includes(origin)) return true;
  if (!URL.canParse(origin)) return false;
  const { protocol, hostname } = new URL(origin);
  if ((protocol !== 'http:' && protocol !== 'https:') || !OWN_HOSTS.includes(hostname)) return false;
  const name = URL.parse(`http://${host ?? ''}/`)?.hostname.toLowerCase() ?? '';
  return OWN_HOSTS.includes(name) || name.startsWith('[') || isIP(name) !== 0 || ownNames.includes(name);
}
