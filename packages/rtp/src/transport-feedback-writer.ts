/** Counterpart of transport-feedback.ts: what a receiver reports about the packets that arrived. */
import { SequenceNumber } from './sequence-number.ts';
import {
  FMT_TRANSPORT_WIDE,
  LARGE_DELTA,
  NOT_RECEIVED,
  RTCP_TRANSPORT_FEEDBACK,
  SMALL_DELTA,
  TRANSPORT_FEEDBACK,
} from './transport-feedback.ts';

const { headerBytes: HEADER_BYTES, deltaUs: DELTA_US, referenceUs: REFERENCE_US } = TRANSPORT_FEEDBACK;
/** A run length chunk counts in 13 bits (§3.1.3 of the draft). */
const MAX_RUN = 0x1fff;
/** Two-bit symbols in a status vector chunk. */
const VECTOR_SYMBOLS = 7;

export interface FeedbackToWrite {
  senderSsrc: number;
  mediaSsrc: number;
  /** Transport-wide sequence number of the first packet reported on, 16 bits. */
  baseSequence: number;
  /** Counts feedback messages, 8 bits. */
  feedbackCount: number;
  /**
   * Arrival time of each packet from the base on, µs of the receiver's clock; NaN if it did not arrive. At least one
   * arrived.
   */
  arrivalsUs: ArrayLike<number>;
}

/**
 * Writes one RTCP packet. Arrivals are in steps of 250 µs. Consecutive arrivals more than ±8.19 s apart cannot be
 * represented: split them into several messages.
 *
 * @throws {RangeError} if no packet arrived, or arrivals are too far apart
 */
export function writeTransportFeedback(feedback: FeedbackToWrite): Uint8Array {
  const { arrivalsUs } = feedback;
  const count = arrivalsUs.length;
  let first = 0;
  while (first < count && Number.isNaN(arrivalsUs[first])) first++;
  if (first === count) throw new RangeError('transport feedback about no packet that came');
  const reference = Math.floor((arrivalsUs[first] as number) / REFERENCE_US);
  const symbols = new Uint8Array(count);
  const deltas = new Int16Array(count);
  let deltaBytes = 0;
  // In whole steps from the reference, so that rounding errors do not add up.
  let lastStep = 0;
  for (let i = 0; i < count; i++) {
    const arrivalUs = arrivalsUs[i] as number;
    if (Number.isNaN(arrivalUs)) continue;
    const step = Math.round((arrivalUs - reference * REFERENCE_US) / DELTA_US);
    const delta = step - lastStep;
    lastStep = step;
    if (delta < -0x8000 || delta > 0x7fff)
      throw new RangeError('arrivals too far apart for one feedback message');
    const isSmall = delta >= 0 && delta <= 0xff;
    symbols[i] = isSmall ? SMALL_DELTA : LARGE_DELTA;
    deltas[i] = delta;
    deltaBytes += isSmall ? 1 : 2;
  }
  const chunks = chunksOf(symbols);
  const used = HEADER_BYTES + chunks.length * 2 + deltaBytes;
  const bytes = new Uint8Array(Math.ceil(used / 4) * 4);
  const view = new DataView(bytes.buffer);
  const padding = bytes.length - used;
  view.setUint8(0, 0x80 | (padding > 0 ? 0x20 : 0) | FMT_TRANSPORT_WIDE);
  view.setUint8(1, RTCP_TRANSPORT_FEEDBACK);
  view.setUint16(2, bytes.length / 4 - 1);
  view.setUint32(4, feedback.senderSsrc);
  view.setUint32(8, feedback.mediaSsrc);
  view.setUint16(12, SequenceNumber.of(feedback.baseSequence));
  view.setUint16(14, count);
  view.setUint32(16, ((reference & 0xffffff) << 8) | (feedback.feedbackCount & 0xff));
  let at = HEADER_BYTES;
  for (const chunk of chunks) {
    view.setUint16(at, chunk);
    at += 2;
  }
  for (let i = 0; i < count; i++) {
    if (symbols[i] === NOT_RECEIVED) continue;
    if (symbols[i] === SMALL_DELTA) view.setUint8(at++, deltas[i] as number);
    else {
      view.setInt16(at, deltas[i] as number);
      at += 2;
    }
  }
  if (padding > 0) view.setUint8(bytes.length - 1, padding);
  return bytes;
}

/**
 * Run-length chunks where a run is longer than a vector, vectors of seven symbols elsewhere. The last vector is padded
 * with 0.
 */
function chunksOf(symbols: Uint8Array): number[] {
  const chunks: number[] = [];
  for (let i = 0; i < symbols.length; ) {
    const symbol = symbols[i] as number;
    let run = 1;
    while (run < MAX_RUN && i + run < symbols.length && symbols[i + run] === symbol) run++;
    if (run > VECTOR_SYMBOLS) {
      chunks.push((symbol << 13) | run);
      i += run;
      continue;
    }
    let chunk = 0xc000;
    for (let s = 0; s < VECTOR_SYMBOLS; s++) chunk |= (symbols[i + s] ?? NOT_RECEIVED) << (12 - 2 * s);
    chunks.push(chunk);
    i += VECTOR_SYMBOLS;
  }
  return chunks;
}
