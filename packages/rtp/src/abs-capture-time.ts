/**
 * The absolute capture time of a frame, as an RTP header extension
 * (http://www.webrtc.org/experiments/rtp-hdrext/abs-capture-time). All fields big-endian:
 *
 *     0  u64 capture time, NTP, UQ32.32 s
 *     8  i64 estimated capture clock offset, Q32.32 s; only in the form of 16 bytes
 */
import { NTP_UNIT, type NtpTime, readNtp, writeNtp } from './ntp-time.ts';

export const ABS_CAPTURE_TIME_URI = 'http://www.webrtc.org/experiments/rtp-hdrext/abs-capture-time';
/** The layout above, in its two forms, bytes. */
export const ABS_CAPTURE_TIME_BYTES = 8;
export const ABS_CAPTURE_TIME_WITH_OFFSET_BYTES = 16;

export interface AbsCaptureTime {
  /** When the frame was captured, on the clock of the system that captured it. */
  captured: NtpTime;
  /**
   * What to add to the capture time to get the sender's own clock, with which its RTCP sender reports are stamped, ms;
   * `null` if the sender does not know, or captured the frame itself.
   */
  clockOffsetMs: number | null;
}

/** Of the seconds of an offset, which are signed. */
const MAX_OFFSET_SECONDS = 0x8000_0000;

/**
 * Writes the data of the extension element, without its header (RFC 8285).
 *
 * @param into room for 8 bytes from `at` on; 16 with an offset
 * @returns the number of bytes written
 * @throws {RangeError} if the offset is not finite or over 2³¹ s, or if there is no room
 */
export function writeAbsCaptureTime(time: AbsCaptureTime, into: Uint8Array, at: number): number {
  const view = new DataView(into.buffer, into.byteOffset, into.byteLength);
  const { captured, clockOffsetMs } = time;
  writeNtp(view, at, captured);
  if (clockOffsetMs === null) return ABS_CAPTURE_TIME_BYTES;
  const seconds = Math.floor(clockOffsetMs / 1000);
  if (!(seconds >= -MAX_OFFSET_SECONDS && seconds < MAX_OFFSET_SECONDS))
    throw new RangeError(`a clock offset of ${clockOffsetMs} ms does not fit`);
  // The fraction counts upwards from the seconds, also below zero. Rounding must not make it a whole second.
  const fraction = Math.min(NTP_UNIT - 1, Math.floor((clockOffsetMs / 1000 - seconds) * NTP_UNIT));
  writeNtp(view, at + ABS_CAPTURE_TIME_BYTES, { seconds, fraction });
  return ABS_CAPTURE_TIME_WITH_OFFSET_BYTES;
}

/**
 * Reads the data of an extension element, without its header.
 *
 * @returns `null` if it is not 8 or 16 bytes long
 */
export function readAbsCaptureTime(data: Uint8Array): AbsCaptureTime | null {
  const hasOffset = data.byteLength === ABS_CAPTURE_TIME_WITH_OFFSET_BYTES;
  if (!hasOffset && data.byteLength !== ABS_CAPTURE_TIME_BYTES) return null;
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const clockOffsetMs = hasOffset
    ? view.getInt32(ABS_CAPTURE_TIME_BYTES) * 1000 +
      (view.getUint32(ABS_CAPTURE_TIME_BYTES + 4) / NTP_UNIT) * 1000
    : null;
  return { captured: readNtp(view, 0), clockOffsetMs };
}
