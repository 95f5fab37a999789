/**
 * The header that rmw_cyclonedds puts before each request and each reply of a service, behind the encapsulation: 64 bits
 * that the client chose, and 64 bits that count its requests. A server sends both back unchanged. Its 16 bytes move
 * nothing that is aligned. Source: `cdds_request_header_t` in rmw_cyclonedds_cpp. Pure.
 */
import { ENCAPSULATION_BYTES } from '@farpoint/ros';

/** Two numbers of 64 bits: rmw_cyclonedds_cpp’s serdata.hpp; request-header.test.ts holds it. */
const HEADER_BYTES = 16;
const MESSAGE_AT = ENCAPSULATION_BYTES + HEADER_BYTES;

export interface RequestHeader {
  /** 64 bits. */
  client: bigint;
  sequence: bigint;
}

/** @param message serialised, with its encapsulation */
export function withRequestHeader({ client, sequence }: RequestHeader, message: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(message.length + HEADER_BYTES);
  bytes.set(message.subarray(0, ENCAPSULATION_BYTES));
  const view = new DataView(bytes.buffer);
  const little = isLittle(message);
  view.setBigUint64(ENCAPSULATION_BYTES, client, little);
  view.setBigInt64(ENCAPSULATION_BYTES + 8, sequence, little);
  bytes.set(message.subarray(ENCAPSULATION_BYTES), MESSAGE_AT);
  return bytes;
}

/**
 * @param bytes whatever came
 * @returns `null` if they are too short for a header
 */
export function readRequestHeader(bytes: Uint8Array): RequestHeader | null {
  if (bytes.length < MESSAGE_AT) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const little = isLittle(bytes);
  return {
    client: view.getBigUint64(ENCAPSULATION_BYTES, little),
    sequence: view.getBigInt64(ENCAPSULATION_BYTES + 8, little),
  };
}

/** The message behind the header, with its encapsulation, in bytes of its own. @param most of the message, bytes; the rest is cut */
export function withoutRequestHeader(bytes: Uint8Array, most: number): Uint8Array {
  const message = bytes.subarray(MESSAGE_AT, MESSAGE_AT + most);
  const whole = new Uint8Array(ENCAPSULATION_BYTES + message.length);
  whole.set(bytes.subarray(0, ENCAPSULATION_BYTES));
  whole.set(message, ENCAPSULATION_BYTES);
  return whole;
}

/** The lowest bit of the kind of CDR is its byte order. */
function isLittle(bytes: Uint8Array): boolean {
  return ((bytes[1] ?? 0) & 1) === 1;
}
