/**
 * The points' RTP stream of one connected robot, opened and answered by us: werift copies and parses each packet several
 * times, keeps no replay window, and tells the sender nothing true of lost packets.
 */
import { Buffer } from 'node:buffer';
import { writeNack } from '@farpoint/congestion';
import { REFERENCE_EXTENSION_ID, REFERENCE_PAYLOAD_TYPE } from '@farpoint/reference-profile';
import type { RTCDtlsTransport } from 'werift';
import { ArrivalFeedback } from './arrival-feedback.ts';
import { LossRequests } from './loss-requests.ts';
import { emptyRtpHeader, readRtpHeader } from './rtp-header.ts';
import { SrtpOpener } from './srtp-opener.ts';

export interface RtpReceiverOptions {
  now: () => number;
  /** How long a packet may be overtaken before it is asked for again, ms. */
  reorderMs: number;
}

const SRTP_AEAD_AES_128_GCM = 7;
/** Often enough for a rate control that reacts to feedback, ms. */
const FEEDBACK_MS = 20;
const AGAIN_MS = 25;
const MOST_REQUESTS = 2;
/** A frame is seldom longer on its way. */
const USELESS_MS = 150;
/** What werift gets to parse instead: a header of no stream that it knows. */
const NOTHING = Buffer.from([0x80, 0x7f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);

export class RtpReceiver {
  packets = 0;
  /** No RTP, of another payload type, not to be opened, or while paused. */
  refused = 0;
  /** Packets are left unopened: nothing of them is wanted. */
  paused = false;
  readonly requests: LossRequests;
  readonly #options: RtpReceiverOptions;
  readonly #dtls: RTCDtlsTransport;
  readonly #onPayload: (payload: Uint8Array) => void;
  readonly #opener: SrtpOpener | null;
  readonly #fallback: (data: Buffer) => Buffer;
  readonly #feedback = new ArrivalFeedback();
  readonly #header = emptyRtpHeader();
  /** Ours in RTCP: any number will do. */
  readonly #ssrc = 1;
  #mediaSsrc = 0;
  #timer: NodeJS.Timeout | null = null;
  #closed = false;

  /** @param dtls connected @throws {Error} for a werift that is built otherwise */
  constructor(dtls: RTCDtlsTransport, options: RtpReceiverOptions, onPayload: (payload: Uint8Array) => void) {
    const { srtp } = dtls;
    if (typeof srtp?.decrypt !== 'function') throw new Error('no SRTP context after DTLS connected');
    this.#dtls = dtls;
    this.#options = options;
    this.#onPayload = onPayload;
    this.requests = new LossRequests({
      reorderMs: Math.min(options.reorderMs, 5),
      againMs: AGAIN_MS,
      most: MOST_REQUESTS,
      uselessMs: USELESS_MS,
    });
    const { profile, srtpSessionKey, srtpSessionSalt } = srtp.remoteContext;
    this.#opener = profile === SRTP_AEAD_AES_128_GCM ? new SrtpOpener(srtpSessionKey, srtpSessionSalt) : null;
    this.#fallback = srtp.decrypt;
    srtp.decrypt = (data: Buffer) => {
      this.#receive(data);
      return NOTHING;
    };
  }

  close(): void {
    this.#closed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
  }

  #receive(packet: Buffer): void {
    if (this.#closed) return;
    const header = this.#header;
    if (
      this.paused ||
      !readRtpHeader(packet, REFERENCE_EXTENSION_ID, header) ||
      header.payloadType !== REFERENCE_PAYLOAD_TYPE
    ) {
      this.refused++;
      return;
    }
    const payload = this.#open(packet, header.bytes);
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

  #open(packet: Buffer, headerBytes: number): Buffer | null {
    if (this.#opener !== null) return this.#opener.open(packet, headerBytes);
    try {
      return this.#fallback(packet).subarray(headerBytes);
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
    // werift seals and sends whatever serialises.
    const packet = { serialize: () => Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength) };
    this.#dtls.sendRtcp([packet] as never).catch(() => undefined);
  }
}
