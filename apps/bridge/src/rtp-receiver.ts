/**
 * The points' RTP stream from one connected robot, decrypted and acknowledged by us. werift copies and parses each
 * packet several times, has no replay window, and reports lost packets wrongly to the sender.
 */

import { Buffer } from 'node:buffer';
import { REFERENCE_MEDIA } from '@farpoint/protocol';
import { ArrivalFeedback, emptyRtpHeader, LossRequests, readRtpHeader, writeNack } from '@farpoint/rtp';
import { SRTP_AEAD_AES_128_GCM, SrtpOpener } from '@farpoint/rtp/srtp';
import { srtpKeys, takeRtp } from '@farpoint/webrtc';
import type { RTCDtlsTransport } from 'werift';

export interface RtpReceiverOptions {
  now: () => number;
  /** How long to wait for a reordered packet before requesting it again, ms. */
  reorderMs: number;
}

/** Feedback interval, ms: short enough for a rate controller that reacts to feedback. */
const FEEDBACK_MS = 20;
const AGAIN_MS = 25;
const MOST_REQUESTS = 2;
/** A packet is not requested again after this long, ms: frames are seldom in flight for longer. */
const USELESS_MS = 150;
export class RtpReceiver {
  packets = 0;
  /** Packets that were not RTP, had another payload type, could not be decrypted, or arrived while paused. */
  refused = 0;
  /** While true, packets are not decrypted, because nothing of them is needed. */
  paused = false;
  readonly requests: LossRequests;
  readonly #options: RtpReceiverOptions;
  readonly #dtls: RTCDtlsTransport;
  readonly #onPayload: (payload: Uint8Array) => void;
  readonly #opener: SrtpOpener | null;
  readonly #feedback = new ArrivalFeedback();
  readonly #header = emptyRtpHeader();
  /** Our SSRC in RTCP; any number will do. */
  readonly #ssrc = 1;
  #mediaSsrc = 0;
  #timer: NodeJS.Timeout | null = null;
  #closed = false;

  /** @param dtls connected @throws {WeriftShapeError} */
  constructor(dtls: RTCDtlsTransport, options: RtpReceiverOptions, onPayload: (payload: Uint8Array) => void) {
    this.#dtls = dtls;
    this.#options = options;
    this.#onPayload = onPayload;
    this.requests = new LossRequests({
      reorderMs: Math.min(options.reorderMs, 5),
      againMs: AGAIN_MS,
      most: MOST_REQUESTS,
      uselessMs: USELESS_MS,
    });
    const { profile, key, salt } = srtpKeys(dtls, 'incoming');
    this.#opener = profile === SRTP_AEAD_AES_128_GCM ? new SrtpOpener(key, salt) : null;
    takeRtp(dtls, (sealed, decipher) => this.#receive(sealed, decipher));
  }

  close(): void {
    this.#closed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
  }

  #receive(packet: Buffer, decipher: (sealed: Buffer) => Buffer): void {
    if (this.#closed) return;
    const header = this.#header;
    if (
      this.paused ||
      !readRtpHeader(packet, REFERENCE_MEDIA.extensionId, header) ||
      header.payloadType !== REFERENCE_MEDIA.payloadType
    ) {
      this.refused++;
      return;
    }
    const payload = this.#open(packet, header.bytes, decipher);
    if (payload === null) {
      this.refused++;
      return;
    }
    this.packets++;
    const now = this.#options.now();
    if (header.ssrc !== this.#mediaSsrc) this.#mediaSsrc = header.ssrc;
    if (header.transportSequence >= 0) this.#feedback.add(header.transportSequence, now);
    this.requests.onPacket(header.sequence, now);
    this.#onPayload(payload);
    this.#timer ??= setTimeout(() => this.#report(), FEEDBACK_MS);
  }

  #open(packet: Buffer, headerBytes: number, decipher: (sealed: Buffer) => Buffer): Buffer | null {
    if (this.#opener !== null) return this.#opener.open(packet, headerBytes);
    try {
      return decipher(packet).subarray(headerBytes);
    } catch {
      return null;
    }
  }

  #report(): void {
    this.#timer = null;
    if (this.#closed) return;
    for (;;) {
      const feedback = this.#feedback.take(this.#ssrc, this.#mediaSsrc);
      if (feedback === null) break;
      this.#send(feedback);
    }
    const missing = this.requests.due(this.#options.now());
    if (missing.length > 0) this.#send(writeNack(this.#ssrc, this.#mediaSsrc, missing));
    if (this.requests.waiting) this.#timer = setTimeout(() => this.#report(), FEEDBACK_MS / 4);
  }

  #send(bytes: Uint8Array): void {
    // werift encrypts and sends any object with `serialize`.
    const packet = { serialize: () => Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength) };
    this.#dtls.sendRtcp([packet] as never).catch(() => undefined);
  }
}
