const SPAN = 0x1_0000_0000;

/**
 * The RTP timestamp of an instant (RFC 3550 §5.1): 32 bits, wrapping.
 *
 * @param clockRate of the payload format, Hz
 */
export function rtpTimestamp(atMs: number, clockRate: number): number {
  return Math.floor(((atMs * clockRate) / 1000) % SPAN) >>> 0;
}

/** The timestamp one tick later. */
export function nextRtpTimestamp(timestamp: number): number {
  return (timestamp + 1) >>> 0;
}
