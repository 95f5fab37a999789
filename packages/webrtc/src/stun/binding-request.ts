/** Checks that a connectivity check belongs to our session (RFC 8489 §9.1, §14.5; RFC 8445 §7.3). */
import { createHmac, timingSafeEqual } from 'node:crypto';

/** Header and cookie (RFC 8489 §5), types of attributes (§18.3), a SHA-1, and the longest username (RFC 5389 §15.3). */
const HEADER_BYTES = 20;
const MAGIC_COOKIE = 0x2112a442;
const USERNAME = 0x0006;
const MESSAGE_INTEGRITY = 0x0008;
const FINGERPRINT = 0x8028;
const INTEGRITY_BYTES = 20;
const MAX_USERNAME_BYTES = 513;

/** `request`, `response` (including error responses) or `indication`; `null` for anything but a STUN message. */
export type StunKind = 'request' | 'response' | 'indication';

export function stunKind(datagram: Buffer): StunKind | null {
  if (datagram.length < HEADER_BYTES || (datagram.readUInt8(0) & 0xc0) !== 0) return null;
  if (datagram.readUInt32BE(4) !== MAGIC_COOKIE) return null;
  const type = datagram.readUInt16BE(0);
  const [high, low] = [(type >> 8) & 1, (type >> 4) & 1];
  if (high === 1) return 'response';
  return low === 1 ? 'indication' : 'request';
}

/**
 * @param passwordOf returns our password for a username fragment of ours, `undefined` for any other
 * @returns whether the request carries our fragment and a MESSAGE-INTEGRITY made with its password, followed by nothing
 * but a fingerprint
 */
export function isAuthenticRequest(
  datagram: Buffer,
  passwordOf: (usernameFragment: string) => string | undefined,
): boolean {
  if (datagram.readUInt16BE(2) !== datagram.length - HEADER_BYTES) return false;
  let password: string | undefined;
  let at = HEADER_BYTES;
  while (at + 4 <= datagram.length) {
    const type = datagram.readUInt16BE(at);
    const length = datagram.readUInt16BE(at + 2);
    const value = at + 4;
    if (value + length > datagram.length) return false;
    if (type === USERNAME) {
      if (length > MAX_USERNAME_BYTES) return false;
      password = passwordOf(datagram.toString('utf8', value, value + length).split(':', 1)[0] ?? '');
    } else if (type === MESSAGE_INTEGRITY) {
      if (password === undefined || length !== INTEGRITY_BYTES) return false;
      const rest = datagram.length - (value + INTEGRITY_BYTES);
      const endsThere =
        rest === 0 || (rest === 8 && datagram.readUInt16BE(value + INTEGRITY_BYTES) === FINGERPRINT);
      return endsThere && isSealed(datagram, at, password);
    }
    at = value + length + ((4 - (length % 4)) % 4);
  }
  return false;
}

/** The MESSAGE-INTEGRITY covers everything before it, with the length set as if it were the last attribute. */
function isSealed(datagram: Buffer, sealAt: number, password: string): boolean {
  const covered = Buffer.from(datagram.subarray(0, sealAt));
  covered.writeUInt16BE(sealAt + 4 + INTEGRITY_BYTES - HEADER_BYTES, 2);
  const seal = createHmac('sha1', password).update(covered).digest();
  return timingSafeEqual(seal, datagram.subarray(sealAt + 4, sealAt + 4 + INTEGRITY_BYTES));
}
