/** The WebRTC connection with a reference operator: the robot offers, the operator answers, ICE trickles. */

import { type IceServer, REFERENCE_MEDIA } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import {
  dropDefaultStun,
  pairLateCandidates,
  prepareSockets,
  type Refusal,
  RemoteCandidates,
} from '@farpoint/webrtc';
import type { RTCDataChannel, RTCPeerConnection, RTCRtpTransceiver } from 'werift';
import { errorText, toWeriftServers } from '../../send/transport/open-peer-connection.ts';
import type { PeerEnd } from '../../send/transport/peer-events.ts';
import { SrtpTransport } from '../../send/transport/srtp-transport.ts';

export interface ReferencePeerOptions {
  iceServers: readonly IceServer[];
  portRange?: readonly [number, number] | undefined;
  icePolicy: 'all' | 'relay';
  /** Time limit for connecting, counted from the answer, ms. */
  connectTimeoutMs: number;
  /** Called when something from the network was dropped unread. */
  onRefused?: ((reason: Refusal) => void) | undefined;
}

export interface ReferencePeerEvents {
  /** Called with each candidate. They are kept from first to last, and sent again after the answer. */
  onCandidate(candidate: string): void;
  onConnected(transport: SrtpTransport): void;
  onMessage(channel: 'control' | 'bandwidth' | 'words', data: string | Uint8Array): void;
  /** The last event. `detail` is for people. */
  onEnded(end: PeerEnd, detail: string): void;
}

export class ReferencePeer {
  /** The candidates found so far. The reference system's bridge ignores those that it gets before its answer. */
  readonly candidates: string[] = [];
  /** Number of the operator's candidates that were left out. */
  candidatesRefused = 0;
  /** Number of channels that the operator opened and that the profile does not have. */
  unknownChannels = 0;
  readonly #options: ReferencePeerOptions;
  readonly #events: ReferencePeerEvents;
  readonly #connection: RTCPeerConnection;
  readonly #cloud: RTCRtpTransceiver;
  readonly #candidates: RemoteCandidates;
  #transport: SrtpTransport | null = null;
  #offerSdp = '';
  #timer: NodeJS.Timeout | null = null;
  #state: 'offering' | 'answered' | 'connected' | 'ended' = 'offering';
  #hasBandwidth = false;
  #hasWords = false;

  constructor(options: ReferencePeerOptions, events: ReferencePeerEvents) {
    this.#options = options;
    this.#events = events;
    const connection = createReferencePeerConnection(
      {
        iceServers: toWeriftServers(options.iceServers),
        portRange: options.portRange,
        icePolicy: options.icePolicy,
      },
      {
        takesRtp: false,
        onRefused: (reason) => options.onRefused?.(reason),
        onUnproven: (error) => this.close('unproven-peer', error.reason),
        onFault: (error) =>
          this.close('connection-lost', `a message could not be handled: ${errorText(error)}`),
      },
    );
    this.#connection = connection;
    this.#candidates = new RemoteCandidates(connection, () => {
      this.candidatesRefused++;
    });
    this.#cloud = connection.addTransceiver('video', { direction: 'sendonly' });
    const { control } = referenceChannels;
    const commands = connection.createDataChannel(control.label, { ordered: control.ordered });
    commands.onMessage.subscribe((data) => this.#events.onMessage('control', data));
    commands.stateChanged.subscribe((state) => {
      if (state === 'closed') this.close('connection-lost', 'the control channel closed');
    });
    connection.onDataChannel.subscribe((channel) => this.#adopt(channel));
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined || this.#state === 'ended') return;
      prepareSockets(connection);
      this.#checkPairs();
      const text = candidate.toJSON().candidate;
      this.candidates.push(text);
      events.onCandidate(text);
    });
    connection.connectionStateChange.subscribe((state) => {
      if (state === 'connected') this.#onConnected();
      else if (state === 'failed' || state === 'closed') {
        this.close(this.#state === 'connected' ? 'connection-lost' : 'not-connected', `connection ${state}`);
      }
    });
  }

  get state(): 'offering' | 'answered' | 'connected' | 'ended' {
    return this.#state;
  }

  /** Whether anything was heard from the operator on the path since the last call, including connectivity checks. */
  heardSinceLast(): boolean {
    return this.#transport?.heardSinceLast() ?? false;
  }

  /** Empty until the offer is made. */
  get offerSdp(): string {
    return this.#offerSdp;
  }

  async offer(): Promise<string> {
    const description = await this.#connection.createOffer();
    dropDefaultStun(this.#cloud.dtlsTransport);
    // Resolves only when all candidates have been gathered.
    this.#connection.setLocalDescription(description).catch((error: unknown) => {
      this.close('not-connected', `no local description: ${errorText(error)}`);
    });
    this.#offerSdp = description.sdp;
    return description.sdp;
  }

  /** Takes the first answer; ignores later ones. Never throws: a bad answer ends the connection. */
  async answer(sdp: string): Promise<void> {
    if (this.#state !== 'offering') return;
    this.#state = 'answered';
    const { connectTimeoutMs } = this.#options;
    this.#timer = setTimeout(
      () => this.close('not-connected', `no connection within ${connectTimeoutMs / 1000} s`),
      connectTimeoutMs,
    );
    try {
      await this.#candidates.describe('answer', sdp);
      this.#checkPairs();
    } catch (error) {
      this.close('bad-answer', errorText(error));
    }
  }

  /**
   * May be called at any time: a candidate waits for the answer. Never throws: unusable candidates are counted, and
   * others may work.
   */
  addCandidate(candidate: string): void {
    if (this.#state !== 'ended') this.#candidates.add({ candidate, sdpMLineIndex: 0 });
  }

  close(end: PeerEnd, detail: string): void {
    if (this.#state === 'ended') return;
    this.#state = 'ended';
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#transport?.close();
    this.#connection.close().catch(() => undefined);
    this.#events.onEnded(end, detail);
  }

  #checkPairs(): void {
    if (this.#connection.remoteDescription !== undefined) pairLateCandidates(this.#cloud.dtlsTransport);
  }

  #adopt(channel: RTCDataChannel): void {
    const { bandwidth, words } = referenceChannels;
    if (channel.label === bandwidth.label && !this.#hasBandwidth) {
      this.#hasBandwidth = true;
      channel.onMessage.subscribe((data) => this.#events.onMessage('bandwidth', data));
    } else if (channel.label === words.label && !this.#hasWords) {
      this.#hasWords = true;
      channel.onMessage.subscribe((data) => this.#events.onMessage('words', data));
    } else {
      this.unknownChannels++;
      channel.close();
    }
  }

  #onConnected(): void {
    if (this.#state !== 'answered') return;
    let transport: SrtpTransport;
    try {
      // Fixed, whatever the answer says: the reference system's bridge assumes a header of 20 bytes.
      transport = new SrtpTransport(this.#cloud, {
        transportSequenceExtensionId: REFERENCE_MEDIA.extensionId,
      });
    } catch (error) {
      this.close('bad-answer', errorText(error));
      return;
    }
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#state = 'connected';
    this.#transport = transport;
    this.#events.onConnected(transport);
  }
}
