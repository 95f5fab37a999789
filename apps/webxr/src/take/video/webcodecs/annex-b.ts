/** What a decoder must know of an H.264 access unit in Annex B format before it decodes it. */

const SPS = 7;
const IDR = 5;

export interface AccessUnit {
  /** RFC 6381, e.g. `avc1.42e01f`; `null` without a sequence parameter set. */
  readonly codec: string | null;
  /** Whether decoding can begin here: it has parameter sets and an IDR slice. */
  readonly isKey: boolean;
}

/** Reads the types of the units in `bytes`. Bytes that are no Annex B stream have none. */
export function readAccessUnit(bytes: Uint8Array): AccessUnit {
  let codec: string | null = null;
  let hasIdr = false;
  for (let at = 0; at + 3 < bytes.length; at++) {
    if (bytes[at] !== 0 || bytes[at + 1] !== 0 || bytes[at + 2] !== 1) continue;
    const type = (bytes[at + 3] as number) & 31;
    if (type === SPS && at + 6 < bytes.length) codec = `avc1.${hexOf(bytes.subarray(at + 4, at + 7))}`;
    // Slices are long, and no parameter sets follow them.
    if (type === IDR) hasIdr = true;
    if (type >= 1 && type <= IDR) break;
    at += 3;
  }
  return { codec, isKey: hasIdr && codec !== null };
}

function hexOf(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}
