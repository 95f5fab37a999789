/** NAL units of an H.264 access unit in the byte stream format (ITU-T H.264 Annex B), and what they say about it. */

/** Types of NAL units (ITU-T H.264 table 7-1), and of RTP's own (RFC 6184 §5.2). */
export const NAL = {
  slice: 1,
  partitionA: 2,
  idrSlice: 5,
  sei: 6,
  sps: 7,
  pps: 8,
  accessUnitDelimiter: 9,
  /** The last type that H.264 may use; 0 and the types above belong to RTP. */
  last: 23,
  stapA: 24,
  fuA: 28,
} as const;

/** The lower five bits of a NAL unit's first byte. */
export function nalType(firstByte: number): number {
  return firstByte & 0x1f;
}

/**
 * The NAL units between the start codes of 3 or 4 bytes, in order: views without start code and without the zeros that
 * may follow a NAL unit. There are none in bytes that do not begin with a start code, or with zeros and a start code.
 */
export function* annexBNalUnits(accessUnit: Uint8Array): Generator<Uint8Array, void, void> {
  let code = startCode(accessUnit, 0);
  for (let i = 0; i < code; i++) if (accessUnit[i] !== 0) return;
  while (code < accessUnit.length) {
    const begin = code + 3;
    code = startCode(accessUnit, begin);
    let end = code;
    while (end > begin && accessUnit[end - 1] === 0) end--;
    if (end > begin) yield accessUnit.subarray(begin, end);
  }
}

/** Where the next 00 00 01 begins; the length if there is none. */
function startCode(bytes: Uint8Array, from: number): number {
  for (let i = from + 2; i < bytes.length; ) {
    const byte = bytes[i] as number;
    if (byte === 0) i++;
    else if (byte === 1 && bytes[i - 1] === 0 && bytes[i - 2] === 0) return i - 2;
    else i += 3;
  }
  return bytes.length;
}

/** Whether a decoder can begin with this access unit (Annex B): it has a slice of an IDR picture. */
export function isH264KeyFrame(accessUnit: Uint8Array): boolean {
  for (const unit of annexBNalUnits(accessUnit)) {
    const type = nalType(unit[0] as number);
    if (type === NAL.idrSlice) return true;
    // All slices of a picture are IDR slices, or none.
    if (type === NAL.slice) return false;
  }
  return false;
}

/**
 * `profile-level-id` for SDP (RFC 6184 §8.1): profile_idc, constraint flags and level_idc of the first sequence
 * parameter set, as six hexadecimal digits in lower case.
 *
 * @param accessUnit Annex B
 * @returns `null` if it has no sequence parameter set
 */
export function h264ProfileLevelId(accessUnit: Uint8Array): string | null {
  for (const unit of annexBNalUnits(accessUnit)) {
    if (nalType(unit[0] as number) !== NAL.sps || unit.length < 4) continue;
    return Array.from(unit.subarray(1, 4), (byte) => byte.toString(16).padStart(2, '0')).join('');
  }
  return null;
}
