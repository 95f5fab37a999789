const LOOPBACK = /^(?:localhost|127(?:\.\d{1,3}){3}|::1|\[::1\])$/;

/**
 * Whether an address stays within this machine.
 *
 * @param host a host name or an IP address, as one writes it or as `URL.hostname` has it; no other name of this machine
 */
export function isLoopbackHost(host: string): boolean {
  return LOOPBACK.test(host);
}
