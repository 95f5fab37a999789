import { ProtocolError } from './errors.ts';

/** The `bandwidth` channel: the operator's estimate or limit as one little-endian int32 in bit/s. */
export const BANDWIDTH_MESSAGE_BYTES = 4;
const MAX_BITS_PER_SECOND = 0x7fffffff;

/** @param bitsPerSecond saturates at 0 and 2³¹−1 */
export function encodeBandwidth(bitsPerSecond: number): Uint8Array {
  const bytes = new Uint8Array(BANDWIDTH_MESSAGE_BYTES);
  const clamped = Math.min(Math.max(Math.round(bitsPerSecond), 0), MAX_BITS_PER_SECOND);
  new DataView(bytes.buffer).setInt32(0, clamped, true);
  return bytes;
}

/**
 * @returns bit/s
 * @throws {ProtocolError} if the message is not exactly one non-negative int32
 */
export function decodeBandwidth(data: ArrayBuffer | Uint8Array): number {
  const bytes = data instanceof Uint8Array ? data : new Uint8Array(data);
  const what = 'bandwidth message';
  if (bytes.byteLength < BANDWIDTH_MESSAGE_BYTES) {
    throw new ProtocolError('too-short', what, '', `${bytes.byteLength} bytes, 4 needed`);
  }
  if (bytes.byteLength > BANDWIDTH_MESSAGE_BYTES) {
    throw new ProtocolError('too-large', what, '', `${bytes.byteLength} bytes, 4 needed`);
  }
  const value = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getInt32(0, true);
  if (value < 0) throw new ProtocolError('invalid', what, '', `negative bit rate ${value}`);
  return value;
}

/** Text messages with which an operator starts and pauses the robot's stream of points. */
export type StreamSwitch = 'start' | 'stop';

/** @throws {ProtocolError} for any other text */
export function decodeStreamSwitch(text: string): StreamSwitch {
  if (text === 'start' || text === 'stop') return text;
  throw new ProtocolError('invalid', 'stream switch', '', "neither 'start' nor 'stop'");
}
