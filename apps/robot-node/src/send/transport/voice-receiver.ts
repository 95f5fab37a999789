/** An operator's voice: RTP, decrypted and acknowledged by us. Nothing of it reaches werift. */
import type { Buffer } from 'node:buffer';
import { ArrivalFeedback, emptyRtpHeader, readRtpHeader } from '@farpoint/rtp';
import { SRTP_AEAD_AES_128_GCM, SrtpOpener } from '@farpoint/rtp/srtp';
import { TokenBucket } from '@farpoint/timing';
import { sendRtcp, srtpKeys, takeRtp } from '@farpoint/webrtc';
import type { RTCDtlsTransport } from 'werift';
import { type VoicePacket, voicePacket } from './voice-packet.ts';

/** Why a packet from an operator is not played. */
export type VoiceRefusal =
  | 'unasked' // the operator does not speak, or must not
  | 'too-many' // more packets than any voice has
  | 'not-rtp'
  | 'other-payload' // not of the m-line for sound
  | 'not-authentic' // forged, repeated, or of too many streams
  | 'bad-padding';

export interface VoiceReceiverOptions {
  payloadType: number;
  /** Of the header extension with the transport-wide sequence number. */
  transportSequenceId: number;
  /** Robot's clock, ms. */
  now: () => number;
}

/** Twice what packets of 10 ms are. */
const MOST_PACKETS = { perSecond: 200, burst: 40 };
/** Feedback interval, ms: libwebrtc's own default. */
const FEEDBACK_MS = 100;
/** Our SSRC in RTCP; any number will do. */
const OWN_SSRC = 1;

export class VoiceReceiver {
  /** Called for each packet; `null` while none is wanted: then packets are not even decrypted. */
  onPacket: ((packet: VoicePacket) => void) | null = null;
  readonly refusals: Partial<Record<VoiceRefusal, number>> = {};
  packets = 0;
  readonly #options: VoiceReceiverOptions;
  readonly #dtls: RTCDtlsTransport;
  readonly #opener: SrtpOpener | null;
  readonly #budget = new TokenBucket(MOST_PACKETS);
  readonly #feedback = new ArrivalFeedback();
  readonly #header = emptyRtpHeader();
  #reportedMs = 0;

  /** @param dtls connected @throws {WeriftShapeError} */
  constructor(dtls: RTCDtlsTransport, options: VoiceReceiverOptions) {
    this.#dtls = dtls;
    this.#options = options;
    const { profile, key, salt } = srtpKeys(dtls, 'incoming');
    this.#opener = profile === SRTP_AEAD_AES_128_GCM ? new SrtpOpener(key, salt) : null;
    takeRtp(dtls, (sealed) => {
      const refusal = this.#take(sealed);
      if (refusal !== null) this.refusals[refusal] = (this.refusals[refusal] ?? 0) + 1;
    });
  }

  #take(sealed: Buffer): VoiceRefusal | null {
    const { payloadType, transportSequenceId, now } = this.#options;
    const nowMs = now();
    if (this.onPacket === null) return 'unasked';
    if (!this.#budget.take(nowMs)) return 'too-many';
    const header = this.#header;
    if (!readRtpHeader(sealed, transportSequenceId, header)) return 'not-rtp';
    if (header.payloadType !== payloadType) return 'other-payload';
    const payload = this.#opener?.open(sealed, header.bytes) ?? null;
    if (payload === null) return 'not-authentic';
    this.#acknowledge(header.transportSequence, header.ssrc, nowMs);
    const packet = voicePacket(sealed, header.sequence, payload);
    if (packet === null) return 'bad-padding';
    // Padding only: a peer probes its path.
    if (packet.payload.length === 0) return null;
    this.packets++;
    this.onPacket(packet);
    return null;
  }

  /** Tells the operator's browser what arrives and when. */
  #acknowledge(transportSequence: number, ssrc: number, nowMs: number): void {
    if (transportSequence < 0) return;
    this.#feedback.add(transportSequence, nowMs);
    if (nowMs - this.#reportedMs < FEEDBACK_MS) return;
    this.#reportedMs = nowMs;
    for (;;) {
      const feedback = this.#feedback.take(OWN_SSRC, ssrc);
      if (feedback === null) return;
      sendRtcp(this.#dtls, feedback);
    }
  }
}
