/** The outside of an Opus packet (RFC 6716 §3). */

/** A frame has at most 1,275 bytes, and a packet at most 120 ms. */
const MOST_FRAME_BYTES = 1275;
const MOST_MS = 120;
/** Frame lengths of the configurations, ms. */
const SILK_MS = [10, 20, 40, 60] as const;
const HYBRID_MS = [10, 20] as const;
const CELT_MS = [2.5, 5, 10, 20] as const;

/**
 * @returns the length of its sound, ms; `null` if it is no valid packet by its first bytes. The decoder checks the rest
 * and conceals what it cannot decode.
 */
export function opusDurationMs(packet: Uint8Array): number | null {
  const toc = packet[0];
  if (toc === undefined) return null;
  const config = toc >> 3;
  const frameMs =
    config < 12 ? SILK_MS[config & 3] : config < 16 ? HYBRID_MS[config & 1] : CELT_MS[config & 3];
  const frames = frameCount(packet, toc & 3);
  if (frameMs === undefined || frames === null) return null;
  const durationMs = frameMs * frames;
  if (durationMs > MOST_MS || packet.length > 2 + frames * (MOST_FRAME_BYTES + 2)) return null;
  return durationMs;
}

function frameCount(packet: Uint8Array, code: number): number | null {
  if (code === 0) return 1;
  // Two frames of equal size (§3.2.3).
  if (code === 1) return packet.length % 2 === 1 ? 2 : null;
  if (code === 2) return packet.length >= 2 ? 2 : null;
  const frames = (packet[1] ?? 0) & 0x3f;
  return frames === 0 ? null : frames;
}
