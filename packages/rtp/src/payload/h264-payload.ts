/** Splits H.264 access units into RTP payloads: RFC 6184 with packetization-mode 1, non-interleaved (§6.3). */
import { annexBNalUnits, NAL, nalType } from './h264-nal.ts';
import { checkPayloadLimit, VideoPayloadError } from './video-payload-error.ts';

/** FU indicator and FU header (§5.8). */
const FU_BYTES = 2;
const START = 0x80;
const END = 0x40;

/**
 * Makes the payloads of one access unit, in sending order. The RTP marker belongs to the last one.
 *
 * Leading NAL units that hold no picture (parameter sets, SEI, access unit delimiter) share a STAP-A (§5.7.1) as far as
 * they fit. Any other NAL unit that fits is a payload by itself (§5.6); a longer one becomes FU-As (§5.8).
 *
 * @param accessUnit one picture in Annex B's byte stream format, start codes of 3 or 4 bytes
 * @param maxPayloadBytes longest payload, without the RTP header; at least 3
 * @returns views of one new buffer, each 1 to `maxPayloadBytes` bytes
 * @throws {VideoPayloadError}
 */
export function packetiseH264(accessUnit: Uint8Array, maxPayloadBytes: number): Uint8Array[] {
  checkPayloadLimit(maxPayloadBytes, FU_BYTES + 1);
  if (accessUnit.length === 0) throw new VideoPayloadError('empty', 'the access unit has no bytes');
  const units = [...annexBNalUnits(accessUnit)];
  if (units.length === 0) throw new VideoPayloadError('no-nal-unit', 'no Annex B start code with a NAL unit');
  const writer = new PayloadWriter(accessUnit.length, maxPayloadBytes);
  let isLeading = true;
  for (let at = 0; at < units.length; ) {
    const unit = units[at] as Uint8Array;
    const type = nalType(unit[0] as number);
    if (type === 0 || type > NAL.last)
      throw new VideoPayloadError('bad-nal-unit', `NAL unit ${at} has type ${type}`);
    isLeading &&= holdsNoPicture(unit);
    const together = isLeading ? fitting(units, at, maxPayloadBytes) : 1;
    if (together > 1) writer.aggregate(units.slice(at, at + together));
    else if (unit.length <= maxPayloadBytes) writer.single(unit);
    else writer.fragment(unit);
    at += together;
  }
  return writer.payloads;
}

function holdsNoPicture(unit: Uint8Array): boolean {
  const type = nalType(unit[0] as number);
  return type >= NAL.sei && type <= NAL.accessUnitDelimiter;
}

/** How many NAL units without picture, from this one on, fit into one STAP-A. */
function fitting(units: readonly Uint8Array[], from: number, maxPayloadBytes: number): number {
  let bytes = 1;
  let end = from;
  for (; end < units.length; end++) {
    const unit = units[end] as Uint8Array;
    bytes += 2 + unit.length;
    if (!holdsNoPicture(unit) || unit.length > 0xffff || bytes > maxPayloadBytes) break;
  }
  return Math.max(1, end - from);
}

/** Writes payloads one behind the other into one buffer. */
class PayloadWriter {
  readonly payloads: Uint8Array[] = [];
  readonly #room: Uint8Array;
  readonly #fragmentBytes: number;
  #at = 0;

  /** The three bytes of each start code make up for all headers but those of fragments. */
  constructor(accessUnitBytes: number, maxPayloadBytes: number) {
    this.#fragmentBytes = maxPayloadBytes - FU_BYTES;
    const fragments = Math.ceil(accessUnitBytes / this.#fragmentBytes);
    this.#room = new Uint8Array(accessUnitBytes + FU_BYTES * fragments);
  }

  single(unit: Uint8Array): void {
    const begin = this.#at;
    this.#copy(unit);
    this.#finish(begin);
  }

  aggregate(units: readonly Uint8Array[]): void {
    const begin = this.#at++;
    // The forbidden bit of any, and the highest importance of all (§5.7).
    let forbidden = 0;
    let importance = 0;
    for (const unit of units) {
      const first = unit[0] as number;
      forbidden |= first & 0x80;
      importance = Math.max(importance, first & 0x60);
      this.#room[this.#at++] = unit.length >> 8;
      this.#room[this.#at++] = unit.length;
      this.#copy(unit);
    }
    this.#room[begin] = forbidden | importance | NAL.stapA;
    this.#finish(begin);
  }

  fragment(unit: Uint8Array): void {
    const first = unit[0] as number;
    // The NAL unit's own first byte is divided between the two headers.
    for (let from = 1; from < unit.length; from += this.#fragmentBytes) {
      const to = Math.min(from + this.#fragmentBytes, unit.length);
      const begin = this.#at;
      this.#room[this.#at++] = (first & 0xe0) | NAL.fuA;
      this.#room[this.#at++] = (from === 1 ? START : 0) | (to === unit.length ? END : 0) | nalType(first);
      this.#copy(unit.subarray(from, to));
      this.#finish(begin);
    }
  }

  #copy(bytes: Uint8Array): void {
    this.#room.set(bytes, this.#at);
    this.#at += bytes.length;
  }

  #finish(begin: number): void {
    this.payloads.push(this.#room.subarray(begin, this.#at));
  }
}
