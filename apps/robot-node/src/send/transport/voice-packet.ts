/** What of an operator's RTP packet is played. Pure. */

/** RTP's fixed header (RFC 3550 §5.1). */
const TIMESTAMP_AT = 4;
const PADDING_BIT = 0x20;

export interface VoicePacket {
  sequence: number;
  /** 1/48000 s. */
  timestamp: number;
  /** An Opus packet, not checked yet; empty in a packet of padding only. */
  payload: Uint8Array;
}

/**
 * @param packet with a header that has been read; its payload may still be encrypted
 * @param payload decrypted
 * @returns `null` if its padding is longer than its payload
 */
export function voicePacket(packet: Uint8Array, sequence: number, payload: Uint8Array): VoicePacket | null {
  let bytes = payload.length;
  if (((packet[0] as number) & PADDING_BIT) !== 0) {
    const padding = payload[bytes - 1] ?? 0;
    if (padding === 0 || padding > bytes) return null;
    bytes -= padding;
  }
  const view = new DataView(packet.buffer, packet.byteOffset, packet.byteLength);
  return { sequence, timestamp: view.getUint32(TIMESTAMP_AT), payload: payload.subarray(0, bytes) };
}
