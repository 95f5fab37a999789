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

/** Characters of a PIN in the address. Chosen: far more than Janus' are. */
const MAX_PIN = 64;

/**
 * @param query the page's query string
 * @param page where the page was loaded from
 * @returns the settings, or one sentence about what is wrong with the address
 */
export function readWatchSettings(
  query: URLSearchParams,
  page: { protocol: string },
): WatchSettings | { fault: string } {
  const url = query.get('janus') ?? '';
  if (url === '')
    return { fault: 'The address of Janus is missing: add ?janus=wss://… to the page’s address.' };
  if (!URL.canParse(url) || !['ws:', 'wss:'].includes(new URL(url).protocol))
    return { fault: 'The address of Janus must begin with wss:// or ws://.' };
  const { protocol, hostname } = new URL(url);
  const isHere = hostname === 'localhost' || hostname === '127.0.0.1' || hostname === '[::1]';
  if (page.protocol === 'https:' && protocol === 'ws:' && !isHere)
    return { fault: 'A page from https:// can use Janus at wss:// only.' };
  const number = query.get('mountpoint') ?? '1';
  const mountpoint = Number(number);
  if (!/^\d{1,10}$/.test(number) || mountpoint < 1 || mountpoint > 2 ** 31 - 1)
    return { fault: 'The mountpoint must be a number from 1.' };
  const pin = query.get('pin') ?? undefined;
  if (pin !== undefined && pin.length > MAX_PIN) return { fault: 'The PIN is too long.' };
  return { url, mountpoint, pin, synchronised: query.get('sync') !== '0' };
}
