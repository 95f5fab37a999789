/**
 * RTCP transport-wide feedback (RTPFB, packet type 205, FMT 15), after
 * draft-holmer-rmcat-transport-wide-cc-extensions-01 §3.1. All fields big-endian:
 *
 *     0  V=2 P FMT=15 | PT=205 | length in 32-bit words, minus one
 *     4  u32 SSRC of the sender        8  u32 SSRC of the media source
 *    12  u16 base sequence number     14  u16 packet status count
 *    16  i24 reference time, 64 ms    19  u8 feedback packet count
 *    20  packet chunks, u16 each, then receive deltas of 250 µs, then padding
 */

import { SequenceNumber } from './sequence-number.ts';

export const RTCP_TRANSPORT_FEEDBACK = 205;
export const FMT_TRANSPORT_WIDE = 15;

/** Why feedback is refused. */
export type TransportFeedbackErrorCode =
  | 'truncated' // the header, the chunks or the deltas are incomplete
  | 'not-transport-feedback' // a different version, packet type or format
  | 'bad-length' // the length field does not match the number of bytes
  | 'bad-padding'
  | 'empty' // reports on no packet
  | 'too-many' // reports on more packets than any sender remembers
  | 'reserved-status'; // the status symbol 3

export class TransportFeedbackError extends Error {
  override readonly name = 'TransportFeedbackError';
  readonly code: TransportFeedbackErrorCode;
  /** Byte offset of the fault. */
  readonly offset: number;

  constructor(code: TransportFeedbackErrorCode, offset: number, detail: string) {
    super(`transport feedback, byte ${offset}: ${detail}`);
    this.code = code;
    this.offset = offset;
  }
}

export interface PacketStatus {
  /** Transport-wide sequence number, 16 bits. */
  sequence: number;
  received: boolean;
  /** The receiver's clock, µs, from the feedback's own reference time; `null` if not received. */
  arrivalUs: number | null;
}

export interface TransportFeedback {
  senderSsrc: number;
  mediaSsrc: number;
  baseSequence: number;
  /** Signed, multiples of 64 ms; wraps every 12.4 days. */
  referenceTimeUs: number;
  /** Counts feedback messages, 8 bits. */
  feedbackCount: number;
  /** One for each sequence number from the base on. */
  packets: PacketStatus[];
}

/** The layout above as numbers, for the writer, too; bytes and µs. */
export const TRANSPORT_FEEDBACK = { headerBytes: 20, deltaUs: 250, referenceUs: 64_000 } as const;
/** Forty bytes can name 65,535 packets. A sender remembers fewer (`SentPacketHistory`): 1.6 s of 10,000 a second. */
const MAX_STATUSES = 16_384;
/** Status symbols; 3 is reserved. */
export const NOT_RECEIVED = 0;
export const SMALL_DELTA = 1;
export const LARGE_DELTA = 2;

/**
 * Parses one RTCP packet, which must fill `bytes` exactly.
 *
 * @throws {TransportFeedbackError} for anything else
 */
export function parseTransportFeedback(bytes: Uint8Array): TransportFeedback {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const end = contentEnd(view);
  const baseSequence = view.getUint16(12);
  const statusCount = view.getUint16(14);
  if (statusCount === 0) throw new TransportFeedbackError('empty', 14, 'reports no packet');
  if (statusCount > MAX_STATUSES)
    throw new TransportFeedbackError('too-many', 14, `reports ${statusCount} packets`);
  const referenceTimeUs = ((view.getUint32(16) | 0) >> 8) * 64_000;

  const symbols = new Uint8Array(statusCount);
  let offset = readChunks(view, end, symbols);
  const packets: PacketStatus[] = new Array(statusCount);
  let timeUs = referenceTimeUs;
  for (let i = 0; i < statusCount; i++) {
    const sequence = SequenceNumber.add(baseSequence, i);
    const symbol = symbols[i];
    if (symbol === NOT_RECEIVED) {
      packets[i] = { sequence, received: false, arrivalUs: null };
      continue;
    }
    const size = symbol === SMALL_DELTA ? 1 : 2;
    if (offset + size > end) {
      throw new TransportFeedbackError('truncated', offset, `no receive delta for packet ${sequence}`);
    }
    timeUs += (size === 1 ? view.getUint8(offset) : view.getInt16(offset)) * TRANSPORT_FEEDBACK.deltaUs;
    offset += size;
    packets[i] = { sequence, received: true, arrivalUs: timeUs };
  }
  return {
    senderSsrc: view.getUint32(4),
    mediaSsrc: view.getUint32(8),
    baseSequence,
    referenceTimeUs,
    feedbackCount: view.getUint8(19),
    packets,
  };
}

/** Checks the RTCP header. @returns where chunks and deltas end, before the padding */
function contentEnd(view: DataView): number {
  if (view.byteLength < TRANSPORT_FEEDBACK.headerBytes) {
    throw new TransportFeedbackError(
      'truncated',
      0,
      `${view.byteLength} bytes, ${TRANSPORT_FEEDBACK.headerBytes} needed`,
    );
  }
  const first = view.getUint8(0);
  if (
    first >> 6 !== 2 ||
    (first & 0x1f) !== FMT_TRANSPORT_WIDE ||
    view.getUint8(1) !== RTCP_TRANSPORT_FEEDBACK
  ) {
    throw new TransportFeedbackError('not-transport-feedback', 0, 'not version 2, FMT 15, packet type 205');
  }
  const length = (view.getUint16(2) + 1) * 4;
  if (length !== view.byteLength) {
    throw new TransportFeedbackError('bad-length', 2, `says ${length} bytes, has ${view.byteLength}`);
  }
  if ((first & 0x20) === 0) return length;
  const padding = view.getUint8(length - 1);
  if (padding === 0 || padding > length - TRANSPORT_FEEDBACK.headerBytes) {
    throw new TransportFeedbackError('bad-padding', length - 1, `${padding} bytes of padding`);
  }
  return length - padding;
}

/** Expands the chunks into one symbol per packet. @returns where the deltas begin */
function readChunks(view: DataView, end: number, symbols: Uint8Array): number {
  let offset = TRANSPORT_FEEDBACK.headerBytes;
  let at = 0;
  while (at < symbols.length) {
    if (offset + 2 > end) {
      throw new TransportFeedbackError(
        'truncated',
        offset,
        `chunks cover ${at} of ${symbols.length} packets`,
      );
    }
    const chunk = view.getUint16(offset);
    const room = symbols.length - at;
    let count: number;
    if ((chunk & 0x8000) === 0) {
      // Run length: 0 | symbol, 2 bits | count, 13 bits.
      count = Math.min(chunk & 0x1fff, room);
      symbols.fill(checkedSymbol((chunk >> 13) & 3, offset), at, at + count);
    } else if ((chunk & 0x4000) === 0) {
      // Vector of 14 one-bit symbols, the first in the highest bit.
      count = Math.min(14, room);
      for (let i = 0; i < count; i++) symbols[at + i] = (chunk >> (13 - i)) & 1;
    } else {
      // Vector of 7 two-bit symbols.
      count = Math.min(7, room);
      for (let i = 0; i < count; i++) symbols[at + i] = checkedSymbol((chunk >> (12 - 2 * i)) & 3, offset);
    }
    at += count;
    offset += 2;
  }
  return offset;
}

function checkedSymbol(symbol: number, offset: number): number {
  if (symbol <= LARGE_DELTA) return symbol;
  throw new TransportFeedbackError('reserved-status', offset, 'status symbol 3');
}
