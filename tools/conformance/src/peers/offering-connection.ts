/** The WebRTC half of a robot like the reference system's: it offers, and streams packets of payload type 5. */

import { Buffer } from 'node:buffer';
import { REFERENCE_MEDIA } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { MediaStreamTrack, type RTCDataChannel, RtpHeader, RtpPacket } from 'werift';
import { Inbox } from './inbox.ts';
import { retransmit } from './retransmit.ts';

export interface OfferingEvents {
  onCandidate(candidate: string): void;
  onCommand(data: string | Buffer): void;
  onBandwidth(data: string | Buffer): void;
  onWord(word: string): void;
  /** The operator has left. */
  onLost?(): void;
}

export class OfferingConnection {
  readonly #connection = createReferencePeerConnection();
  readonly #track = new MediaStreamTrack({ kind: 'video' });
  readonly #ready = new Inbox<true>();
  #sequence = 0;
  #timestamp = 0;
  #closed = false;

  constructor(events: OfferingEvents) {
    const connection = this.#connection;
    connection.addTransceiver(this.#track, { direction: 'sendonly' });
    const { control, bandwidth, words } = referenceChannels;
    const commands = connection.createDataChannel(control.label, { ordered: control.ordered });
    commands.onMessage.subscribe((data) => events.onCommand(data));
    commands.stateChanged.subscribe((state) => {
      if (state === 'closed' && !this.#closed) events.onLost?.();
    });
    const adopted: RTCDataChannel[] = [];
    const checkReady = () => {
      const open = [commands, ...adopted].every(({ readyState }) => readyState === 'open');
      if (open && adopted.some(({ label }) => label === words.label)) this.#ready.push(true);
    };
    commands.stateChanged.subscribe(checkReady);
    connection.onDataChannel.subscribe((channel) => {
      adopted.push(channel);
      channel.stateChanged.subscribe(checkReady);
      channel.onMessage.subscribe((data) => {
        if (channel.label === bandwidth.label) events.onBandwidth(data);
        else events.onWord(data.toString());
      });
      checkReady();
    });
    connection.connectionStateChange.subscribe((state) => {
      const dtls = connection.dtlsTransports[0];
      if (state === 'connected' && dtls !== undefined) retransmit(dtls);
    });
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate !== undefined) events.onCandidate(candidate.toJSON().candidate);
    });
  }

  get connected(): boolean {
    return this.#connection.connectionState === 'connected';
  }

  /** Returns its SDP; candidates follow one by one. */
  async offer(): Promise<string> {
    const offer = await this.#connection.createOffer();
    // Resolves only when every candidate is gathered.
    this.#connection.setLocalDescription(offer).catch(() => undefined);
    return offer.sdp;
  }

  /** @throws {Error} for an answer that it does not accept */
  async answer(sdp: string): Promise<void> {
    await this.#connection.setRemoteDescription({ type: 'answer', sdp });
  }

  /** Ignores an unusable candidate. */
  async addCandidate(candidate: string): Promise<void> {
    await this.#connection.addIceCandidate({ candidate, sdpMLineIndex: 0 }).catch(() => undefined);
  }

  /** Resolves once its own channel and the one for `start` and `stop` are open: anything sent earlier may be lost. */
  async ready(timeoutMs?: number): Promise<void> {
    await this.#ready.next(undefined, timeoutMs, 'an operator whose channels are open');
  }

  /**
   * Sends one packet per payload, all of one frame.
   *
   * @param timestampStep since the previous frame, in units of the 90 kHz clock
   */
  sendFrame(payloads: readonly Uint8Array[], timestampStep = 9000): void {
    if (this.#closed) return;
    this.#timestamp += timestampStep;
    payloads.forEach((payload, i) => {
      const header = new RtpHeader({
        payloadType: REFERENCE_MEDIA.payloadType,
        sequenceNumber: this.#sequence++ & 0xffff,
        timestamp: this.#timestamp >>> 0,
        marker: i === payloads.length - 1,
      });
      this.#track.writeRtp(new RtpPacket(header, Buffer.from(payload)));
    });
  }

  async close(): Promise<void> {
    this.#closed = true;
    await this.#connection.close();
  }
}
