/**
 * Messages between this program and `farpoint-sound`, on its standard input and output. `native/main.c` is the other
 * side.
 */
import {
  COMMON_FROM_PROCESS,
  COMMON_TO_PROCESS,
  HEADER_BYTES,
  WireError,
  WireMessageParser,
  writeMessage,
} from '@farpoint/media-process';
import { msOfNs, nsOfMs } from '@farpoint/timing';

export const TO_PROCESS = { ...COMMON_TO_PROCESS, play: 3 } as const;
export const FROM_PROCESS = { sound: 65, ...COMMON_FROM_PROCESS } as const;

/** What is before the packet: u64 time; and u64 time, u32 duration. */
const SOUND_HEAD_BYTES = 8;
const PLAY_HEAD_BYTES = 12;
/** An Opus packet of 20 ms has at most 1,275 bytes, and a state is short. */
const MOST_MESSAGE_BYTES = 64 * 1024;

/** Puts the messages of `farpoint-sound` together. */
export class MessageParser extends WireMessageParser {
  constructor() {
    super(Object.values(FROM_PROCESS), MOST_MESSAGE_BYTES);
  }
}

/** One packet of a microphone. */
export interface SoundPacket {
  /** When its first sample was captured: CLOCK_MONOTONIC, the clock of `process.hrtime`, ms. */
  readonly capturedAtMs: number;
  /** An Opus packet (RFC 6716). */
  readonly bytes: Uint8Array;
}

/** @throws {WireError} `bad-message` */
export function parseSound(payload: Uint8Array): SoundPacket {
  if (payload.length <= SOUND_HEAD_BYTES)
    throw new WireError('bad-message', `a packet of ${payload.length} bytes`);
  const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
  const captureNs = view.getBigUint64(0, true);
  return {
    capturedAtMs: msOfNs(captureNs),
    bytes: payload.subarray(SOUND_HEAD_BYTES),
  };
}

export function writeConfigure(bitsPerS: number): Uint8Array {
  const payload = new Uint8Array(4);
  new DataView(payload.buffer).setUint32(0, Math.round(bitsPerS), true);
  return writeMessage(TO_PROCESS.configure, payload);
}

/**
 * A packet for the loudspeaker.
 *
 * @param hearAtMs when it is to be heard, before the device's own delay: CLOCK_MONOTONIC, ms
 * @param durationMs of its sound
 * @param bytes an Opus packet; empty for one that was lost and is to be concealed
 */
export function writePlay(hearAtMs: number, durationMs: number, bytes: Uint8Array): Uint8Array {
  const message = new Uint8Array(HEADER_BYTES + PLAY_HEAD_BYTES + bytes.length);
  const view = new DataView(message.buffer);
  view.setUint32(0, PLAY_HEAD_BYTES + bytes.length, true);
  view.setUint8(4, TO_PROCESS.play);
  view.setBigUint64(5, nsOfMs(hearAtMs), true);
  view.setUint32(13, Math.round(durationMs * 1000), true);
  message.set(bytes, HEADER_BYTES + PLAY_HEAD_BYTES);
  return message;
}
