/**
 * RTCP sender reports (packet type 200, RFC 3550 §6.4.1): which wall clock time a stream's RTP timestamps stand for.
 * Report blocks may follow (receiver-report.ts). All fields big-endian:
 *
 *     0  V=2 P RC | PT=200 | length in 32-bit words, minus one
 *     4  u32 SSRC of the sender
 *     8  u64 NTP time                 16  u32 RTP timestamp of the same instant
 *    20  u32 packets sent             24  u32 octets of payload sent
 */
import { type NtpTime, readNtp, writeNtp } from './ntp-time.ts';
import { REPORT_BLOCK_BYTES, RTCP_SENDER_REPORT } from './receiver-report.ts';

const BYTES = 28;

export interface SenderReport {
  ssrc: number;
  /** When the report was sent, on the sender's clock. */
  ntp: NtpTime;
  /** The same instant in units of the stream's clock, with the stream's offset; 32 bits. */
  rtpTimestamp: number;
  /** Since the stream began; 32 bits, wraps. */
  packets: number;
  /** Payload bytes, without headers and padding, since the stream began; 32 bits, wraps. */
  octets: number;
}

/** Why a sender report is refused. */
export type SenderReportFault = 'not-sender-report' | 'truncated' | 'bad-length';

/** Writes a report without report blocks; counts and timestamp may exceed 32 bits. */
export function writeSenderReport(report: SenderReport): Uint8Array {
  const bytes = new Uint8Array(BYTES);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, 0x80);
  view.setUint8(1, RTCP_SENDER_REPORT);
  view.setUint16(2, BYTES / 4 - 1);
  view.setUint32(4, report.ssrc);
  writeNtp(view, 8, report.ntp);
  view.setUint32(16, report.rtpTimestamp);
  view.setUint32(20, report.packets);
  view.setUint32(24, report.octets);
  return bytes;
}

/**
 * Reads one RTCP packet, including its header.
 *
 * @param onReport called with the report if it is valid
 * @returns why the packet cannot be read; `null` if it is valid
 */
export function readSenderReport(
  bytes: Uint8Array,
  onReport: (report: SenderReport) => void,
): SenderReportFault | null {
  if (bytes.byteLength < BYTES) return 'truncated';
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = view.getUint8(0);
  if (first >> 6 !== 2 || view.getUint8(1) !== RTCP_SENDER_REPORT) return 'not-sender-report';
  if ((view.getUint16(2) + 1) * 4 !== bytes.byteLength) return 'bad-length';
  if (bytes.byteLength < BYTES + (first & 0x1f) * REPORT_BLOCK_BYTES) return 'truncated';
  onReport({
    ssrc: view.getUint32(4),
    ntp: readNtp(view, 8),
    rtpTimestamp: view.getUint32(16),
    packets: view.getUint32(20),
    octets: view.getUint32(24),
  });
  return null;
}
