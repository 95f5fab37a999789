import * as z from 'zod/mini';

/** SHA-256 of a DTLS certificate, as SDP writes it (RFC 8122 §5). */
export const fingerprintSchema = z.string().check(z.regex(/^(?:[0-9A-F]{2}:){31}[0-9A-F]{2}$/));

const LINE = /^a=fingerprint:sha-256 ((?:[0-9A-F]{2}:){31}[0-9A-F]{2})$/i;

/**
 * The one certificate that a description names. A description with several could be read differently by whoever signs
 * and whoever connects, so each mention of a fingerprint must be the same line.
 *
 * @returns in upper case; `null` if there is none, another hash than SHA-256, or more than one
 */
export function soleFingerprint(sdp: string): string | null {
  let found: string | null = null;
  for (const line of sdp.split(/[\r\n]+/)) {
    if (!/fingerprint/i.test(line)) continue;
    const [, value] = LINE.exec(line) ?? [];
    if (value === undefined) return null;
    const fingerprint = value.toUpperCase();
    if (found !== null && found !== fingerprint) return null;
    found = fingerprint;
  }
  return found;
}
