import { createRequire } from 'node:module';
import { ADDON_FILE } from './build.ts';

/** Mistakes of the caller are thrown as a TypeError with the code `RANGE`; nothing else throws. */
export interface Addon {
  /** The local port of a bound UDP socket; 0 for any other descriptor. */
  udpPort(fd: number): number;
  /** Whether the kernel can cut one message into datagrams (UDP_SEGMENT). */
  knowsSegments(fd: number): boolean;
  /**
   * Sends the first `count` datagrams, without waiting. They lie in `bytes` one after the other.
   *
   * @param count at most {@link MOST_DATAGRAMS}
   * @param segments whether datagrams of equal length may leave as one message, to be cut up by the kernel
   * @returns see {@link readSending}
   */
  send(
    fd: number,
    address: string,
    port: number,
    bytes: Uint8Array,
    lengths: Uint32Array,
    count: number,
    segments: boolean,
  ): number;
}

/** The most datagrams of one call. */
export const MOST_DATAGRAMS = 64;

const STOPS = ['done', 'full', 'segments', 'refused'] as const;

/** What became of a batch. */
export interface Sending {
  /** How many datagrams the kernel took. */
  sent: number;
  /**
   * Why it took no more: it has all of them; the socket is full for now; the path takes no segmented messages, and the
   * rest may go without; or the system refuses the next datagram.
   */
  stop: (typeof STOPS)[number];
}

const STOP_UNIT = 0x1_0000;

/** Reads what {@link Addon.send} returned. */
export function readSending(result: number): Sending {
  const stop = STOPS[Math.floor(result / STOP_UNIT)];
  return stop === undefined ? { sent: 0, stop: 'refused' } : { sent: result % STOP_UNIT, stop };
}

let loaded: Addon | null | undefined;

/** @returns `null` if the addon is not built or cannot be loaded: datagrams then leave one by one */
export function loadAddon(): Addon | null {
  if (loaded === undefined) {
    try {
      loaded = createRequire(import.meta.url)(ADDON_FILE) as Addon;
    } catch {
      loaded = null;
    }
  }
  return loaded;
}
