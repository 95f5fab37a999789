/** Reads the RTP payloads of H.264 access units (RFC 6184, packetization-mode 1) into Annex B's byte stream format. */
import type { FrameBuffer } from './frame-buffer.ts';
import { annexBNalUnits, NAL, nalType } from './h264-nal.ts';
import type { FrameKind, PayloadFault, PayloadReader } from './payload-reader.ts';

const START_CODE = new Uint8Array([0, 0, 0, 1]);

export class H264Reader implements PayloadReader {
  /** The type of the NAL unit whose last fragment is still to come; 0 if there is none. */
  #open = 0;
  #units = 0;
  /** Whether there have been parameter sets in whole frames, and whether IDR pictures bring their own. */
  #hasSps = false;
  #hasPps = false;
  #repeatsSps = true;
  readonly #firstByte = new Uint8Array(1);

  reset(): void {
    this.#open = 0;
    this.#units = 0;
  }

  beginsFrame(payload: Uint8Array): boolean {
    const second = payload[1] ?? 0;
    switch (nalType(payload[0] as number)) {
      case NAL.fuA:
        return (second & 0x80) !== 0 && this.#beginsPicture(second, payload[2]);
      case NAL.stapA:
        return this.#beginsPicture(payload[3] ?? 0, payload[4]);
      default:
        return this.#beginsPicture(payload[0] as number, second);
    }
  }

  append(payload: Uint8Array, frame: FrameBuffer): PayloadFault | null {
    const first = payload[0] as number;
    const type = nalType(first);
    if (type === NAL.fuA) return this.#fragment(payload, frame);
    if (this.#open !== 0) return 'malformed';
    if (type === NAL.stapA) return this.#aggregate(payload, frame);
    return this.#unit(payload, frame);
  }

  finish(frame: Uint8Array): FrameKind | null {
    if (this.#open !== 0) return null;
    let units = 0;
    let isKeyFrame = false;
    let hasSps = false;
    let hasPps = false;
    for (const unit of annexBNalUnits(frame)) {
      const type = nalType(unit[0] as number);
      units++;
      isKeyFrame ||= type === NAL.idrSlice;
      hasSps ||= type === NAL.sps;
      hasPps ||= type === NAL.pps;
    }
    // A start code inside a NAL unit would smuggle another one in (ITU-T H.264 §7.4.1 forbids it).
    if (units !== this.#units) return null;
    this.#hasSps ||= hasSps;
    this.#hasPps ||= hasPps;
    if (isKeyFrame) this.#repeatsSps = hasSps;
    return { isKeyFrame: isKeyFrame && this.#hasSps && this.#hasPps };
  }

  /**
   * Whether nothing that matters can come before this NAL unit in its frame. In front of an IDR picture, that is its
   * parameter sets, if the stream repeats them.
   *
   * @param second byte of the NAL unit: a slice begins with first_mb_in_slice, 0 if the first bit is set (§7.3.3)
   */
  #beginsPicture(first: number, second = 0): boolean {
    const type = nalType(first);
    if (type >= NAL.sei && type <= NAL.accessUnitDelimiter) return true;
    if (type === NAL.idrSlice && this.#repeatsSps) return false;
    const isSlice = type === NAL.slice || type === NAL.partitionA || type === NAL.idrSlice;
    return isSlice && (second & 0x80) !== 0;
  }

  #unit(unit: Uint8Array, frame: FrameBuffer): PayloadFault | null {
    if (!isValid(unit[0] as number)) return 'malformed';
    return this.#begin(frame) && frame.append(unit) ? null : 'too-large';
  }

  #aggregate(payload: Uint8Array, frame: FrameBuffer): PayloadFault | null {
    if (((payload[0] as number) & 0x80) !== 0 || payload.length < 4) return 'malformed';
    for (let at = 1; at < payload.length; ) {
      if (at + 2 >= payload.length) return 'malformed';
      const begin = at + 2;
      const end = begin + (((payload[at] as number) << 8) | (payload[at + 1] as number));
      if (end === begin || end > payload.length) return 'malformed';
      const fault = this.#unit(payload.subarray(begin, end), frame);
      if (fault !== null) return fault;
      at = end;
    }
    return null;
  }

  #fragment(payload: Uint8Array, frame: FrameBuffer): PayloadFault | null {
    if (payload.length < 3) return 'malformed';
    const header = payload[1] as number;
    const isFirst = (header & 0x80) !== 0;
    const isLast = (header & 0x40) !== 0;
    const type = nalType(header);
    const first = ((payload[0] as number) & 0xe0) | type;
    if ((isFirst && isLast) || !isValid(first) || this.#open !== (isFirst ? 0 : type)) return 'malformed';
    if (isFirst) {
      this.#firstByte[0] = first;
      if (!this.#begin(frame) || !frame.append(this.#firstByte)) return 'too-large';
    }
    this.#open = isLast ? 0 : type;
    return frame.append(payload.subarray(2)) ? null : 'too-large';
  }

  #begin(frame: FrameBuffer): boolean {
    this.#units++;
    return frame.append(START_CODE);
  }
}

/** Not marked as damaged (F), and of a type that H.264 may use. */
function isValid(firstByte: number): boolean {
  const type = nalType(firstByte);
  return (firstByte & 0x80) === 0 && type >= 1 && type <= NAL.last;
}
