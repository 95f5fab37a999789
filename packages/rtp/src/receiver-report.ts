/** Report blocks of RTCP sender and receiver reports (RFC 3550 §6.4): what a receiver got of a stream. */

export const RTCP_SENDER_REPORT = 200;
export const RTCP_RECEIVER_REPORT = 201;

/** RTCP's header and the SSRC of the sender; what a sender report has in addition; a report block: bytes. */
const HEADER_BYTES = 8;
const SENDER_INFO_BYTES = 20;
export const REPORT_BLOCK_BYTES = 24;

export interface ReportBlock {
  /** Of the stream that the block reports on. */
  ssrc: number;
  /** Since the stream began; a duplicate reduces it by one. */
  packetsLost: number;
  /** Extended by the number of wraps, 32 bits. */
  highestSequence: number;
  /** In units of the stream's clock. */
  jitter: number;
}

/**
 * Reads one RTCP packet, including its header.
 *
 * @param packetType 200 or 201
 * @param onBlock gets each block: one object, which the next block overwrites
 * @returns false if the packet is too short for the blocks it announces; `onBlock` is not called then
 */
export function readReportBlocks(
  packetType: number,
  bytes: Uint8Array,
  onBlock: (block: Readonly<ReportBlock>) => void,
): boolean {
  const begin = HEADER_BYTES + (packetType === RTCP_SENDER_REPORT ? SENDER_INFO_BYTES : 0);
  const count = (bytes[0] ?? 0) & 0x1f;
  if (bytes.byteLength < begin + count * REPORT_BLOCK_BYTES) return false;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const block: ReportBlock = { ssrc: 0, packetsLost: 0, highestSequence: 0, jitter: 0 };
  for (let at = begin; at < begin + count * REPORT_BLOCK_BYTES; at += REPORT_BLOCK_BYTES) {
    block.ssrc = view.getUint32(at);
    // Signed, 24 bits.
    block.packetsLost = (view.getInt32(at + 4) << 8) >> 8;
    block.highestSequence = view.getUint32(at + 8);
    block.jitter = view.getUint32(at + 12);
    onBlock(block);
  }
  return true;
}
