/** What the page watches, from its address. It is checked here and trusted everywhere else. */

export interface WatchSettings {
  /** Janus' WebSocket. */
  url: string;
  /** Number of the robot's mountpoint. */
  mountpoint: number;
  pin: string | undefined;
  /** Whether videos are presented in step. */
  synchronised: boolean;
}

/** What is wrong with the page's address. */
export type WatchFault = 'no-janus' | 'not-websocket' | 'needs-wss' | 'bad-mountpoint' | 'long-pin';

/** Characters of a PIN in the address. Chosen: far more than Janus' are. */
const MAX_PIN = 64;

/**
 * @param query the page's query string
 * @param page where the page was loaded from
 * @returns the settings, or what is wrong with the address
 */
export function readWatchSettings(
  query: URLSearchParams,
  page: { protocol: string },
): WatchSettings | { fault: WatchFault } {
  const url = query.get('janus') ?? '';
  if (url === '') return { fault: 'no-janus' };
  if (!URL.canParse(url) || !['ws:', 'wss:'].includes(new URL(url).protocol))
    return { fault: 'not-websocket' };
  const { protocol, hostname } = new URL(url);
  const isHere = hostname === 'localhost' || hostname === '127.0.0.1' || hostname === '[::1]';
  if (page.protocol === 'https:' && protocol === 'ws:' && !isHere) return { fault: 'needs-wss' };
  const number = query.get('mountpoint') ?? '1';
  const mountpoint = Number(number);
  if (!/^\d{1,10}$/.test(number) || mountpoint < 1 || mountpoint > 2 ** 31 - 1)
    return { fault: 'bad-mountpoint' };
  const pin = query.get('pin') ?? undefined;
  if (pin !== undefined && pin.length > MAX_PIN) return { fault: 'long-pin' };
  return { url, mountpoint, pin, synchronised: query.get('sync') !== '0' };
}
