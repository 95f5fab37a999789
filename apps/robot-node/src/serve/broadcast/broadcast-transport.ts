import { Buffer } from 'node:buffer';
import { randomBytes, randomInt } from 'node:crypto';
import type { ResendRefusal } from '@farpoint/rtp';
import { deriveSrtpCmKeys, SRTP_CM_TAG_BYTES, type SrtpCmKeys, SrtpCmSealer } from '@farpoint/rtp/srtp';
import { type RtpTransport, UDP_IPV4_BYTES } from '../../send/transport/rtp-transport.ts';

/** RFC 3550, 5.1: the fixed header, and its first byte without padding, extension and sources. */
const RTP_HEADER_BYTES = 12;
const VERSION_2 = 0x80;

/** Sends one packet to the relay, in pieces; never fails. */
export type SendDatagram = (pieces: readonly Uint8Array[]) => void;

/**
 * One RTP stream to a relay: plain RTP, or SRTP where the relay has been given a key. The relay sends no receiver
 * reports and asks for nothing again, so nothing is kept.
 */
export class BroadcastTransport implements RtpTransport {
  onRtcp: ((compound: Uint8Array) => void) | null = null;
  readonly overheadBytes: number;
  /** Nothing is learned from reports: there are none, and a viewer's REMB must not slow down the others. */
  readonly transportFeedback = true;
  readonly resendRefusals: Readonly<Record<ResendRefusal, number>> = { unknown: 0, 'too-late': 0, resent: 0 };
  readonly #payloadType: number;
  readonly #keys: SrtpCmKeys | null;
  readonly #usedSsrcs = new Set<number>();
  #send: SendDatagram | null = null;
  #ssrc = 0;
  #sealer: SrtpCmSealer | null = null;
  #sequence = 0;

  /** @param master SRTP key and salt, 30 bytes; `null` for packets in clear */
  constructor(payloadType: number, master: Uint8Array | null) {
    this.#payloadType = payloadType;
    this.#keys = master === null ? null : deriveSrtpCmKeys(master);
    this.overheadBytes = RTP_HEADER_BYTES + (master === null ? 0 : SRTP_CM_TAG_BYTES) + UDP_IPV4_BYTES;
    this.renew();
  }

  get ssrc(): number {
    return this.#ssrc;
  }

  get ready(): boolean {
    return this.#send !== null;
  }

  /** @param send `null`: packets are dropped from now on */
  connect(send: SendDatagram | null): void {
    this.#send = send;
  }

  /**
   * Continues as another source. A receiver of SRTP counts how often the sequence numbers have wrapped; after an outage
   * it may have counted wrong, and would refuse everything from then on. With a new source it begins again.
   */
  renew(): void {
    // Never the same again: SSRC and sequence number choose the keystream.
    do this.#ssrc = randomBytes(4).readUInt32BE();
    while (this.#usedSsrcs.has(this.#ssrc));
    this.#usedSsrcs.add(this.#ssrc);
    this.#sequence = randomInt(0x8000);
    this.#sealer = this.#keys === null ? null : new SrtpCmSealer(this.#keys, this.#ssrc, this.#sequence);
  }

  send(payload: Uint8Array, timestamp: number, marker: boolean): number | null {
    if (this.#send === null) return null;
    const sequence = this.#sequence;
    this.#sequence = (sequence + 1) & 0xffff;
    const header = Buffer.allocUnsafe(RTP_HEADER_BYTES);
    header[0] = VERSION_2;
    header[1] = (marker ? 0x80 : 0) | this.#payloadType;
    header.writeUInt16BE(sequence, 2);
    header.writeUInt32BE(timestamp, 4);
    header.writeUInt32BE(this.#ssrc, 8);
    this.#send(this.#sealer === null ? [header, payload] : this.#sealer.seal(header, payload));
    return sequence;
  }

  /** A packet that says nothing but where it comes from: RTCP's answers are sent there. */
  knock(): Uint8Array {
    const packet = Buffer.alloc(RTP_HEADER_BYTES);
    packet[0] = VERSION_2;
    packet[1] = this.#payloadType;
    packet.writeUInt32BE(this.#ssrc, 8);
    return packet;
  }

  resend(): number {
    return 0;
  }

  receiverSums(): null {
    return null;
  }
}
