import { Buffer } from 'node:buffer';
import { randomInt } from 'node:crypto';
import type { ReceiverSums } from '@farpoint/congestion';
import type { VideoCodec } from '@farpoint/protocol';
import {
  ABS_CAPTURE_TIME_URI,
  ntpOfUnixMs,
  type ReportBlock,
  ResendHistory,
  RtpHeaderTemplate,
  rtpTimestamp,
  SequenceNumber,
  writeSenderReport,
} from '@farpoint/rtp';
import { SRTP_AEAD_AES_128_GCM, SRTP_GCM_TAG_BYTES, SrtpSealer } from '@farpoint/rtp/srtp';
import { IcePath, sendRtcp, srtpKeys, tapRtcp } from '@farpoint/webrtc';
import { type RTCDtlsTransport, type RTCRtpTransceiver, RTP_EXTENSION_URI } from 'werift';
import { ReportSums } from './report-sums.ts';
import { type RtpTransport, UDP_IPV4_BYTES } from './rtp-transport.ts';

/** The peer does not support what the stream needs. */
export class RtpTransportError extends Error {
  override readonly name = 'RtpTransportError';
}

export interface SrtpTransportOptions {
  /** Overrides the negotiated id of the transport-wide sequence number. */
  transportSequenceExtensionId?: number | undefined;
  /** Called with the bundle's RTCP; only one transport of a bundle may ask for it. */
  rtcp?: boolean | undefined;
  /** What to add to the robot's clock for the time since 1970, ms. With it, packets carry their capture time. */
  unixOffsetMs?: number | undefined;
  /** The payload type of each codec that the peer takes; by default, all packets have the first negotiated one. */
  payloadTypes?: ReadonlyMap<VideoCodec, number> | undefined;
}

/**
 * Sends an RTP stream on a connected werift transceiver, encrypted by us, because werift's own sender copies and
 * serialises each packet several times. werift never sends RTP on this SSRC, so each nonce is used once. The
 * transport-wide sequence number is werift's own counter, shared with everything else that it sends in the bundle.
 */
export class SrtpTransport implements RtpTransport {
  onRtcp: ((compound: Uint8Array) => void) | null = null;
  readonly ssrc: number;
  readonly overheadBytes: number;
  readonly transportFeedback: boolean;
  readonly #dtls: RTCDtlsTransport;
  readonly #path: IcePath;
  readonly #header: RtpHeaderTemplate;
  readonly #sealer: SrtpSealer;
  readonly #reports: ReportSums | null;
  /**
   * Encrypted packets, kept as they are: encrypting other bytes under the same number would reveal the key (RFC 7714
   * §8.4).
   */
  readonly #sent = new ResendHistory();
  readonly #unixOffsetMs: number;
  readonly #payloadTypes: ReadonlyMap<VideoCodec, number> | undefined;
  /** Of the newest packet. */
  #codec: VideoCodec | undefined;
  /** The capture time in the header: that of a frame's packets is the same. */
  #capturedAtMs = Number.NaN;
  #packetsSent = 0;
  #payloadBytesSent = 0;
  /** The path is looked up once per turn of the event loop, not once per packet. */
  #pathIsFresh = false;
  #pathIsOpen = false;
  #closed = false;

  /**
   * @param transceiver negotiated, on a connected DTLS transport
   * @throws {RtpTransportError} if the answer refused the codec or AES-128-GCM
   */
  constructor(transceiver: RTCRtpTransceiver, options: SrtpTransportOptions = {}) {
    const { sender, mid } = transceiver;
    const codec = sender.codec;
    if (codec === undefined || mid === null) throw new RtpTransportError('the peer refused the stream');
    const dtls = transceiver.dtlsTransport;
    const { profile, key, salt } = srtpKeys(dtls, 'outgoing');
    if (profile !== SRTP_AEAD_AES_128_GCM)
      throw new RtpTransportError('the peer does not take SRTP with AES-128-GCM');
    const extensionId = (uri: string) => transceiver.headerExtensions.find((e) => e.uri === uri)?.id;
    const transportSequenceId =
      options.transportSequenceExtensionId ?? extensionId(RTP_EXTENSION_URI.transportWideCC);
    this.transportFeedback =
      transportSequenceId !== undefined && codec.rtcpFeedback.some(({ type }) => type === 'transport-cc');
    // A peer that gives transport-wide feedback is not asked for receiver reports as well.
    this.#reports = this.transportFeedback ? null : new ReportSums(sender.ssrc);
    this.#header = new RtpHeaderTemplate({
      payloadType: codec.payloadType,
      ssrc: sender.ssrc,
      mid,
      midExtensionId: extensionId(RTP_EXTENSION_URI.sdesMid),
      transportSequenceExtensionId: transportSequenceId,
      captureTimeExtensionId:
        options.unixOffsetMs === undefined ? undefined : extensionId(ABS_CAPTURE_TIME_URI),
    });
    this.ssrc = sender.ssrc;
    this.#unixOffsetMs = options.unixOffsetMs ?? 0;
    this.#payloadTypes = options.payloadTypes;
    this.#sealer = new SrtpSealer(key, salt, sender.ssrc, randomInt(0x8000));
    this.#dtls = dtls;
    this.#path = new IcePath(dtls);
    this.overheadBytes = this.#header.bytes.length + SRTP_GCM_TAG_BYTES + UDP_IPV4_BYTES;
    if (options.rtcp !== false) tapRtcp(dtls, (compound) => this.onRtcp?.(compound));
  }

  get ready(): boolean {
    this.#refreshPath();
    return this.#pathIsOpen;
  }

  get resendRefusals() {
    return this.#sent.refusals;
  }

  send(
    payload: Uint8Array,
    timestamp: number,
    marker: boolean,
    nowMs: number,
    usefulMs: number,
    capturedAtMs = nowMs,
    codec?: VideoCodec,
  ): number | null {
    this.#refreshPath();
    if (!this.#pathIsOpen || !this.#takes(codec)) return null;
    const transportSequence = SequenceNumber.next(this.#dtls.transportSequenceNumber);
    this.#dtls.transportSequenceNumber = transportSequence;
    const { nextSequence } = this.#sealer;
    if (this.#header.hasCaptureTime && capturedAtMs !== this.#capturedAtMs) {
      this.#capturedAtMs = capturedAtMs;
      this.#header.patchCaptureTime(ntpOfUnixMs(capturedAtMs + this.#unixOffsetMs));
    }
    this.#header.patch(marker, nextSequence, timestamp, transportSequence);
    // A copy is needed: the kernel may read a datagram that it cannot take immediately from memory later.
    const header = Buffer.from(this.#header.bytes);
    const sealed = this.#sealer.seal(header, payload);
    this.#sent.add(nextSequence, sealed, nowMs, usefulMs);
    this.#reports?.onSent(nextSequence, nowMs);
    this.#path.send(sealed);
    this.#packetsSent++;
    this.#payloadBytesSent += payload.length;
    return transportSequence;
  }

  /**
   * Sends a sender report (RFC 3550 §6.4.1) that pairs the robot's clock with the stream's timestamps, which are capture
   * times on that clock.
   *
   * @param clockRate of the stream's timestamps, 1/s
   */
  sendReport(nowMs: number, clockRate: number): void {
    if (!this.ready) return;
    const report = writeSenderReport({
      ssrc: this.ssrc,
      ntp: ntpOfUnixMs(nowMs + this.#unixOffsetMs),
      rtpTimestamp: rtpTimestamp(nowMs, clockRate),
      packets: this.#packetsSent,
      octets: this.#payloadBytesSent,
    });
    sendRtcp(this.#dtls, report);
  }

  receiverSums(block: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null {
    return this.#reports?.read(block, nowMs) ?? null;
  }

  resend(sequence: number, nowMs: number): number {
    this.#refreshPath();
    const sealed = this.#pathIsOpen ? this.#sent.take(sequence, nowMs) : null;
    if (sealed === null) return 0;
    this.#path.send([Buffer.from(sealed.buffer)]);
    return sealed.length + UDP_IPV4_BYTES;
  }

  /** @returns whether anything was heard from the peer since the last call, including connectivity checks */
  heardSinceLast(): boolean {
    return this.#path.heardSinceLast();
  }

  /** Stops sending at once; werift takes a while to close. */
  close(): void {
    this.#closed = true;
    this.#pathIsOpen = false;
    this.onRtcp = null;
  }

  /** Sets the payload type of the next packets; false if the peer has none for them. */
  #takes(codec: VideoCodec | undefined): boolean {
    if (codec === this.#codec || codec === undefined || this.#payloadTypes === undefined) return true;
    const payloadType = this.#payloadTypes.get(codec);
    if (payloadType === undefined) return false;
    this.#codec = codec;
    this.#header.patchPayloadType(payloadType);
    return true;
  }

  #refreshPath(): void {
    if (this.#pathIsFresh) return;
    this.#pathIsOpen = !this.#closed && this.#dtls.state === 'connected' && this.#path.refresh();
    this.#pathIsFresh = true;
    queueMicrotask(() => {
      this.#pathIsFresh = false;
    });
  }
}
