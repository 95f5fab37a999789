import type { Secret } from '@farpoint/service';

/** Where a robot's broadcast goes, and what it may take. */
export interface BroadcastOptions {
  /** Janus' WebSocket. */
  url: string;
  /** Whoever has it may create mountpoints; `null` if Janus asks for none. */
  adminKey: Secret | null;
  /** The mountpoint's number in Janus. */
  mountpoint: number;
  /** Asked of those who watch; `null` for none. */
  pin: Secret | null;
  /** Where Janus takes the packets, if not at the WebSocket's host. */
  host: string | null;
  /** On the wire, at most, bit/s. */
  bitsPerSecond: number;
  /** Least time between two key frames of a video that viewers ask for, ms. */
  keyFrameMs: number;
  clouds: boolean;
  /** PEM certificates to trust in addition, or `null`. */
  ca: string | null;
}

/** Whether a host is this machine, so that packets to it cannot be seen by others. */
export function isLoopback(host: string): boolean {
  return host === 'localhost' || host === '::1' || host === '[::1]' || /^127(\.\d{1,3}){3}$/.test(host);
}
