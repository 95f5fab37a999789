import { Buffer } from 'node:buffer';
import { randomInt } from 'node:crypto';
import type { ReceiverSums } from '@farpoint/congestion';
import { type ReportBlock, ResendHistory, RtpHeaderTemplate, SequenceNumber } from '@farpoint/rtp';
import { SRTP_AEAD_AES_128_GCM, SRTP_GCM_TAG_BYTES, SrtpSealer } from '@farpoint/rtp/srtp';
import { IcePath, srtpKeys, tapRtcp } from '@farpoint/webrtc';
import { type RTCDtlsTransport, type RTCRtpTransceiver, RTP_EXTENSION_URI } from 'werift';
import { type CloudTransport, UDP_IPV4_BYTES } from './cloud-transport.ts';
import { ReportSums } from './report-sums.ts';

/** The peer does not support what the stream needs. */
export class CloudTransportError extends Error {
  override readonly name = 'CloudTransportError';
}

/**
 * Sends cloud packets on a connected werift transceiver, encrypted by us, because werift's own sender copies and
 * serialises each packet several times. werift never sends RTP on this SSRC, so each nonce is used once. The
 * transport-wide sequence number is werift's own counter, shared with everything else that it sends in the bundle.
 */
export class SrtpCloudTransport implements CloudTransport {
  onRtcp: ((compound: Uint8Array) => void) | null = null;
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
  readonly #sent = new ResendHistory<readonly Buffer[]>();
  /** The path is looked up once per turn of the event loop, not once per packet. */
  #pathIsFresh = false;
  #pathIsOpen = false;
  #closed = false;

  /**
   * @param transceiver negotiated, on a connected DTLS transport
   * @param transportSequenceExtensionId overrides the negotiated id of the transport-wide sequence number
   * @throws {CloudTransportError} if the answer refused the codec or AES-128-GCM
   */
  constructor(transceiver: RTCRtpTransceiver, transportSequenceExtensionId?: number) {
    const { sender, mid } = transceiver;
    const codec = sender.codec;
    if (codec === undefined || mid === null)
      throw new CloudTransportError('the peer refused the cloud stream');
    const dtls = transceiver.dtlsTransport;
    const { profile, key, salt } = srtpKeys(dtls, 'outgoing');
    if (profile !== SRTP_AEAD_AES_128_GCM)
      throw new CloudTransportError('the peer does not take SRTP with AES-128-GCM');
    const extensionId = (uri: string) => transceiver.headerExtensions.find((e) => e.uri === uri)?.id;
    const transportSequenceId =
      transportSequenceExtensionId ?? extensionId(RTP_EXTENSION_URI.transportWideCC);
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
    });
    this.#sealer = new SrtpSealer(key, salt, sender.ssrc, randomInt(0x8000));
    this.#dtls = dtls;
    this.#path = new IcePath(dtls);
    this.overheadBytes = this.#header.bytes.length + SRTP_GCM_TAG_BYTES + UDP_IPV4_BYTES;
    tapRtcp(dtls, (compound) => this.onRtcp?.(compound));
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
  ): number | null {
    this.#refreshPath();
    if (!this.#pathIsOpen) return null;
    const transportSequence = SequenceNumber.next(this.#dtls.transportSequenceNumber);
    this.#dtls.transportSequenceNumber = transportSequence;
    const { nextSequence } = this.#sealer;
    this.#header.patch(marker, nextSequence, timestamp, transportSequence);
    // A copy is needed: the kernel may read a datagram that it cannot take immediately from memory later.
    const header = Buffer.from(this.#header.bytes);
    const sealed = this.#sealer.seal(header, payload);
    this.#sent.add(nextSequence, sealed, nowMs, usefulMs);
    this.#reports?.onSent(nextSequence, nowMs);
    this.#path.send(sealed);
    return transportSequence;
  }

  receiverSums(block: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null {
    return this.#reports?.read(block, nowMs) ?? null;
  }

  resend(sequence: number, nowMs: number): number {
    this.#refreshPath();
    const sealed = this.#pathIsOpen ? this.#sent.take(sequence, nowMs) : null;
    if (sealed === null) return 0;
    this.#path.send(sealed);
    return sealed.reduce((sum, part) => sum + part.length, UDP_IPV4_BYTES);
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

  #refreshPath(): void {
    if (this.#pathIsFresh) return;
    this.#pathIsOpen = !this.#closed && this.#dtls.state === 'connected' && this.#path.refresh();
    this.#pathIsFresh = true;
    queueMicrotask(() => {
      this.#pathIsFresh = false;
    });
  }
}
