/**
 * Web pages that may connect. A browser lets any page open a socket to this machine, so without this check every page
 * that somebody visits could watch through the robot's cameras.
 */

const OWN_HOSTS: readonly string[] = ['localhost', '127.0.0.1', '[::1]'];
/** Foxglove in the browser, and viewers installed as programs, whose pages are files. */
const VIEWERS: readonly string[] = ['https://app.foxglove.dev', 'https://studio.foxglove.dev', 'file://'];

/** @param origin as the browser says; programs need not say any */
export function isAllowedOrigin(origin: string | undefined, allowed: readonly string[]): boolean {
  if (origin === undefined || VIEWERS.includes(origin)) return true;
  if (allowed.includes('*') || allowed.includes(origin)) return true;
  if (!URL.canParse(origin)) return false;
  const { protocol, hostname } = new URL(origin);
  return (protocol === 'http:' || protocol === 'https:') && OWN_HOSTS.includes(hostname);
}
