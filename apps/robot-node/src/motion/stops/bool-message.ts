import { ENCAPSULATION_BYTES } from '@farpoint/ros';

/** What a serialised std_msgs/Bool says. Everything but a well-formed false is a stop. */
export function saysStop(version: 1 | 2, bytes: Uint8Array): boolean {
  if (version === 1) return bytes.length !== 1 || bytes[0] !== 0;
  // DDS may pad the message to four bytes.
  const content = bytes.length - ENCAPSULATION_BYTES;
  return content < 1 || content > 4 || bytes[ENCAPSULATION_BYTES] !== 0;
}

/** A serialised std_msgs/Bool. */
export function boolMessage(version: 1 | 2, value: boolean): Uint8Array {
  const data = value ? 1 : 0;
  // Little-endian CDR.
  return Uint8Array.from(version === 1 ? [data] : [0, 1, 0, 0, data]);
}
