import type { ReceiverSums } from '@farpoint/congestion';
import {
  FULL_POINT_PACKET_BYTES,
  MAX_POINT_DATA_BYTES,
  nextSequence32,
  PLACEMENT_BYTES,
  POINT_PACKET_OFFSETS,
  REFERENCE_MEDIA,
} from '@farpoint/protocol';
import { nextRtpTimestamp, type ReportBlock, type ResendRefusal, rtpTimestamp } from '@farpoint/rtp';
import type { RtpTransport } from '../../send/transport/rtp-transport.ts';

/**
 * Sends Farpoint's payloads in the form of the reference profile: the same points, without the placement, always 1216
 * bytes, with frames counted from 0 for each connection.
 */
export class ReferenceTransport implements RtpTransport {
  /** Number of the last frame sent; −1 before the first. */
  frameNumber = -1;
  readonly overheadBytes: number;
  readonly #inner: RtpTransport;
  readonly #now: () => number;
  readonly #payload = new Uint8Array(FULL_POINT_PACKET_BYTES);
  readonly #view = new DataView(this.#payload.buffer);
  #source: number | null = null;
  #rtpTimestamp = 0;

  /** @param now robot's clock, ms */
  constructor(inner: RtpTransport, now: () => number) {
    this.#inner = inner;
    this.#now = now;
    this.overheadBytes = inner.overheadBytes - PLACEMENT_BYTES;
  }

  get ssrc(): number {
    return this.#inner.ssrc;
  }

  get ready(): boolean {
    return this.#inner.ready;
  }

  get resendRefusals(): Readonly<Record<ResendRefusal, number>> {
    return this.#inner.resendRefusals;
  }

  get transportFeedback(): boolean {
    return this.#inner.transportFeedback;
  }

  receiverSums(block: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null {
    return this.#inner.receiverSums(block, nowMs);
  }

  get onRtcp(): ((compound: Uint8Array) => void) | null {
    return this.#inner.onRtcp;
  }

  set onRtcp(handler: ((compound: Uint8Array) => void) | null) {
    this.#inner.onRtcp = handler;
  }

  /**
   * @param payload a full packet of a frame that has only whole packets; `timestamp` is ignored, because its clock is
   * a different one
   */
  send(
    payload: Uint8Array,
    _timestamp: number,
    marker: boolean,
    nowMs: number,
    usefulMs: number,
  ): number | null {
    this.#payload.set(payload.subarray(0, FULL_POINT_PACKET_BYTES));
    this.#beginFrame(this.#view.getUint32(POINT_PACKET_OFFSETS.frameNumber, true));
    this.#view.setUint32(POINT_PACKET_OFFSETS.frameNumber, this.frameNumber, true);
    // In Farpoint's profile, the frame may end with a partial packet. Here it ends with its last whole packet.
    const length = this.#view.getUint32(POINT_PACKET_OFFSETS.frameLength, true);
    const whole = length - (length % MAX_POINT_DATA_BYTES);
    this.#view.setUint32(POINT_PACKET_OFFSETS.frameLength, whole, true);
    this.#view.setUint32(POINT_PACKET_OFFSETS.sequenceLength, MAX_POINT_DATA_BYTES, true);
    return this.#inner.send(this.#payload, this.#rtpTimestamp, marker, nowMs, usefulMs);
  }

  resend(sequence: number, nowMs: number): number {
    return this.#inner.resend(sequence, nowMs);
  }

  #beginFrame(source: number): void {
    if (source === this.#source) return;
    this.#source = source;
    this.frameNumber = nextSequence32(this.frameNumber);
    const timestamp = rtpTimestamp(this.#now(), REFERENCE_MEDIA.clockRate);
    // The timestamp must advance with every frame, even if two frames begin at the same time.
    this.#rtpTimestamp = timestamp === this.#rtpTimestamp ? nextRtpTimestamp(timestamp) : timestamp;
  }
}
