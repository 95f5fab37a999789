/** One packet of a compound RTCP packet (RFC 3550 §6.1). */
export interface RtcpPacket {
  packetType: number;
  /** The five bits that hold a report count, a source count or a feedback message type. */
  format: number;
  /** The whole packet, including header and padding; a view into the compound packet. */
  bytes: Uint8Array;
}

/** Why the rest of a compound packet is not read. */
export type RtcpFault = 'truncated' | 'bad-version';

/**
 * Walks through a decrypted compound RTCP packet, or a reduced-size one (RFC 5506).
 *
 * @param onFault called once if the walk cannot continue; the packets before the fault are valid
 */
export function* walkRtcp(
  compound: Uint8Array,
  onFault?: (fault: RtcpFault, offset: number) => void,
): Generator<RtcpPacket, void, void> {
  const view = new DataView(compound.buffer, compound.byteOffset, compound.byteLength);
  let offset = 0;
  while (offset < compound.byteLength) {
    if (offset + 4 > compound.byteLength) return onFault?.('truncated', offset);
    const first = view.getUint8(offset);
    if (first >> 6 !== 2) return onFault?.('bad-version', offset);
    const end = offset + (view.getUint16(offset + 2) + 1) * 4;
    if (end > compound.byteLength) return onFault?.('truncated', offset);
    yield {
      packetType: view.getUint8(offset + 1),
      format: first & 0x1f,
      bytes: compound.subarray(offset, end),
    };
    offset = end;
  }
}
