/** The bytes of a call to a ROS 1 service over TCPROS. Pure: the socket is elsewhere. */
import { RosFault } from '../fault.ts';

/** Longer headers and answers are refused: those of std_srvs are far shorter. */
export const MOST_SERVICE_BYTES = 64 * 1024;
const LENGTH_BYTES = 4;

/** A connection’s header: each field after its length, all after the length of all. */
export function connectionHeader(fields: Readonly<Record<string, string>>): Uint8Array {
  const parts = Object.entries(fields).map(([name, value]) =>
    framed(new TextEncoder().encode(`${name}=${value}`)),
  );
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return framed(all);
}

/** The bytes after their length. */
export function framed(bytes: Uint8Array): Uint8Array {
  const whole = new Uint8Array(LENGTH_BYTES + bytes.length);
  new DataView(whole.buffer).setUint32(0, bytes.length, true);
  whole.set(bytes, LENGTH_BYTES);
  return whole;
}

/**
 * @returns the header’s fields, and how many bytes it takes; `null` while it is not complete
 * @throws {RosFault} `too-large` or `bad-message`
 */
export function readConnectionHeader(
  bytes: Uint8Array,
): { fields: ReadonlyMap<string, string>; length: number } | null {
  const all = readFramed(bytes, 0);
  if (all === null) return null;
  const fields = new Map<string, string>();
  for (let at = 0; at < all.length; ) {
    const field = readFramed(all, at);
    if (field === null)
      throw new RosFault('bad-message', 'a field is longer than its header', { offset: at });
    const text = new TextDecoder().decode(field);
    const equals = text.indexOf('=');
    if (equals < 1) throw new RosFault('bad-message', 'a field without a name', { offset: at });
    fields.set(text.slice(0, equals), text.slice(equals + 1));
    at += LENGTH_BYTES + field.length;
  }
  return { fields, length: LENGTH_BYTES + all.length };
}

/**
 * @returns the answer, or the service’s error where `ok` is false; `null` while it is not complete
 * @throws {RosFault} `too-large` or `bad-message`
 */
export function readServiceAnswer(bytes: Uint8Array): { ok: boolean; payload: Uint8Array } | null {
  const [ok] = bytes;
  if (ok === undefined) return null;
  if (ok > 1) throw new RosFault('bad-message', `an answer that begins with ${ok}`);
  const payload = readFramed(bytes, 1);
  return payload === null ? null : { ok: ok === 1, payload };
}

function readFramed(bytes: Uint8Array, at: number): Uint8Array | null {
  if (bytes.length < at + LENGTH_BYTES) return null;
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(at, true);
  if (length > MOST_SERVICE_BYTES)
    throw new RosFault('too-large', `${length} bytes, at most ${MOST_SERVICE_BYTES} are read`);
  const from = at + LENGTH_BYTES;
  return bytes.length < from + length ? null : bytes.subarray(from, from + length);
}
