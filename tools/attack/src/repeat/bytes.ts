/** Bytes of SCTP chunks, RTCP packets and STUN messages, as big as an attacker likes. */
import { Message } from 'werift';

export const bytes2 = (value: number): number[] => [(value >> 8) & 255, value & 255];
export const bytes4 = (value: number): number[] => [...bytes2(value >>> 16), ...bytes2(value)];
export const filled = (length: number, value = 0): number[] => new Array<number>(length).fill(value);
export const times = (count: number, part: (n: number) => readonly number[]): number[] =>
  Array.from({ length: count }, (_, n) => part(n)).flat();

/** What lists in a packet of 1,200 bytes may have of entries of four bytes. */
export const MANY = 280;

export function chunk(type: number, body: readonly number[], flags = 0): number[] {
  return [type, flags, ...bytes2(body.length + 4), ...body, ...filled(-body.length & 3)];
}

export const [LAST, FIRST, UNORDERED] = [1, 2, 4];
const [BINARY, DCEP] = [53, 50];

/** A DATA chunk of one byte. */
export function data(tsn: number, stream: number, flags = FIRST | LAST | UNORDERED): number[] {
  return chunk(0, [...bytes4(tsn), ...bytes2(stream), 0, 0, ...bytes4(BINARY), 7], flags);
}

/** Opens a channel without a name. */
export function opening(tsn: number, stream: number): number[] {
  const open = [3, 0, ...filled(10)];
  return chunk(0, [...bytes4(tsn), ...bytes2(stream), 0, 0, ...bytes4(DCEP), ...open], FIRST | LAST);
}

export function parameters(count: number, type = 1): number[] {
  return times(count, () => [...bytes2(type), 0, 4]);
}

export function sack(
  cumulative: number,
  gaps: readonly number[],
  repeated: readonly number[] = [],
): number[] {
  const counts = [...bytes2(gaps.length / 4), ...bytes2(repeated.length / 4)];
  return chunk(3, [...bytes4(cumulative), 0, 16, 0, 0, ...counts, ...gaps, ...repeated]);
}

/** A RE-CONFIG parameter that resets these streams. */
export function resets(streams: readonly number[]): number[] {
  const length = 16 + 2 * streams.length;
  return [0, 13, ...bytes2(length), ...filled(12), ...streams.flatMap(bytes2), ...filled(-length & 3)];
}

/** One RTCP packet. */
export function rtcp(type: number, format: number, body: readonly number[]): Buffer {
  const padded = [...body, ...filled(-body.length & 3)];
  return Buffer.from([0x80 | format, type, ...bytes2(padded.length / 4), ...padded]);
}

/** Feedback (RFC 4585 §6.1) of SSRC 1 on SSRC 1. */
export function feedback(type: number, format: number, information: readonly number[] = []): Buffer {
  return rtcp(type, format, [0, 0, 0, 1, 0, 0, 0, 1, ...information]);
}

/** Transport-wide feedback on so many packets, all lost. */
export function losses(statuses: number): Buffer {
  return feedback(205, 15, [0, 0, ...bytes2(statuses), 0, 0, 0, 1, ...times(10, () => [0x1f, 0xff])]);
}

/** A STUN message of the class; a binding request with these attributes is sealed by the password. */
export function stunMessage(
  messageClass: number,
  attributes: Readonly<Record<string, unknown>> = {},
): Message {
  const message = new Message(1, messageClass);
  for (const [name, value] of Object.entries(attributes))
    message.setAttribute(name as 'USERNAME', value as string);
  return message;
}
