/** What a receiver needs from an RTP header (RFC 3550, RFC 8285 one-byte extensions). Reading it allocates nothing. */

export interface RtpHeaderView {
  /** Length of the whole header, including the extension. */
  bytes: number;
  payloadType: number;
  sequence: number;
  ssrc: number;
  /** Transport-wide sequence number; −1 if there is none. */
  transportSequence: number;
}

/** Without CSRCs and extension (RFC 3550 §5.1), bytes. */
export const RTP_FIXED_BYTES = 12;
/** Says that one-byte extension elements follow (RFC 8285 §4.2). */
export const ONE_BYTE_PROFILE = 0xbede;

export function emptyRtpHeader(): RtpHeaderView {
  return { bytes: 0, payloadType: 0, sequence: 0, ssrc: 0, transportSequence: -1 };
}

/**
 * @param packet encrypted or not: only the payload is encrypted
 * @param extensionId id of the transport-wide sequence number
 * @returns false if it is no RTP packet
 */
export function readRtpHeader(packet: Uint8Array, extensionId: number, into: RtpHeaderView): boolean {
  if (packet.length < RTP_FIXED_BYTES) return false;
  const first = packet[0] as number;
  if (first >> 6 !== 2) return false;
  into.payloadType = (packet[1] as number) & 0x7f;
  into.sequence = u16(packet, 2);
  into.ssrc = u16(packet, 8) * 0x1_0000 + u16(packet, 10);
  into.transportSequence = -1;
  let at = RTP_FIXED_BYTES + (first & 0x0f) * 4;
  if ((first & 0x10) !== 0) {
    if (packet.length < at + 4) return false;
    const end = at + 4 + u16(packet, at + 2) * 4;
    if (packet.length < end) return false;
    if (u16(packet, at) === ONE_BYTE_PROFILE) readElements(packet, at + 4, end, extensionId, into);
    at = end;
  }
  into.bytes = at;
  return packet.length >= at;
}

function readElements(packet: Uint8Array, from: number, end: number, id: number, into: RtpHeaderView): void {
  for (let at = from; at < end; ) {
    const element = packet[at] as number;
    if (element === 0) {
      at++;
      continue;
    }
    const length = (element & 0x0f) + 1;
    if (element >> 4 === 15 || at + 1 + length > end) return;
    if (element >> 4 === id && length >= 2) into.transportSequence = u16(packet, at + 1);
    at += 1 + length;
  }
}

function u16(bytes: Uint8Array, at: number): number {
  return ((bytes[at] as number) << 8) | (bytes[at + 1] as number);
}
