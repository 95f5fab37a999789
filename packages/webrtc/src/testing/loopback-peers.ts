/** For tests: a guarded peer that offers, and an unguarded werift peer that answers and may misbehave. */
import { Waiters } from '@farpoint/service/testing/waiters';
import {
  MediaStream,
  type RTCDataChannel,
  type RTCDtlsTransport,
  RTCPeerConnection,
  useOPUS,
  useVP8,
} from 'werift';
import type { UnprovenPeerError } from '../dtls/peer-proof.ts';
import type { Refusals } from '../refusal.ts';
import type { DtlsSocketShape } from '../werift/dtls-endpoint.ts';
import { guardConnection } from '../werift/guard-connection.ts';

interface DtlsKeys {
  keyPem: string;
  certPem: string;
  signatureHash: { hash: 4; signature: 3 };
}

export interface LoopbackOptions {
  /** Keys of the answering peer's certificate. */
  keys?: DtlsKeys | undefined;
  /** Modifies the answer in transit. */
  onAnswer?: ((sdp: string) => string) | undefined;
  /** Gets the answering peer's DTLS socket before its handshake begins. */
  onClientSocket?: ((socket: DtlsSocketShape) => void) | undefined;
  /** Whether the other peer drives now. */
  drives?: (() => boolean) | undefined;
  /** The guarded peer answers, as the DTLS client, and the other one offers. */
  guardedAnswers?: boolean | undefined;
  /** Gets the guarded peer's transport before anything happens on it. */
  onGuardedTransport?: ((transport: RTCDtlsTransport) => void) | undefined;
}

export class LoopbackPeers {
  readonly guarded: RTCPeerConnection;
  readonly other: RTCPeerConnection;
  readonly refusals: Refusals;
  readonly heard: string[] = [];
  readonly faults: unknown[] = [];
  unproven: UnprovenPeerError | null = null;
  toGuarded!: RTCDataChannel;
  /** May throw inside the guarded peer's listener. */
  onHeard: ((text: string) => void) | null = null;
  readonly #waiters = new Waiters();

  private constructor({ keys, drives }: LoopbackOptions) {
    const common = {
      iceServers: [],
      iceUseIpv6: false,
      bundlePolicy: 'max-bundle' as const,
      codecs: { audio: [useOPUS()], video: [useVP8()] },
    };
    this.guarded = new RTCPeerConnection(common);
    this.other = new RTCPeerConnection({ ...common, ...(keys === undefined ? {} : { dtls: { keys } }) });
    this.refusals = guardConnection(this.guarded, {
      drives: () => drives?.() === true,
      onRefused: () => this.#waiters.changed(),
      onUnproven: (error) => {
        this.unproven = error;
        this.#waiters.changed();
      },
      onFault: (error) => {
        this.faults.push(error);
        this.#waiters.changed();
      },
    });
    for (const peer of [this.guarded, this.other]) {
      peer.connectionStateChange.subscribe(() => this.#waiters.changed());
    }
  }

  static async open(options: LoopbackOptions = {}): Promise<LoopbackPeers> {
    const peers = new LoopbackPeers(options);
    const { guarded, other } = peers;
    const [offerer, answerer] = options.guardedAnswers === true ? [other, guarded] : [guarded, other];
    other.onDataChannel.subscribe(() => undefined);
    guarded.onDataChannel.subscribe((channel) => {
      channel.onMessage.subscribe((data) => {
        peers.onHeard?.(data.toString());
        peers.heard.push(data.toString());
        peers.#waiters.changed();
      });
    });
    offerer.addTransceiver('audio', { direction: 'sendonly', streams: [new MediaStream({ id: 's' })] });
    offerer.createDataChannel('first');
    if (offerer === other) peers.toGuarded = other.createDataChannel('test');
    const candidatesFor = (from: RTCPeerConnection, to: RTCPeerConnection, ready: Promise<unknown>) =>
      from.onIceCandidate.subscribe((candidate) => {
        if (candidate === undefined) return;
        const { candidate: text, sdpMid = null, sdpMLineIndex = null } = candidate.toJSON();
        void ready.then(() =>
          to.addIceCandidate({ candidate: text, sdpMid, sdpMLineIndex }).catch(() => undefined),
        );
      });
    const answered = Promise.withResolvers<void>();
    const offered = Promise.withResolvers<void>();
    candidatesFor(offerer, answerer, offered.promise);
    candidatesFor(answerer, offerer, answered.promise);
    const offer = await offerer.createOffer();
    const [transport] = guarded.dtlsTransports;
    if (transport !== undefined) options.onGuardedTransport?.(transport);
    offerer.setLocalDescription(offer).catch(() => undefined);
    await answerer.setRemoteDescription(offer);
    offered.resolve();
    if (answerer === other) peers.toGuarded = other.createDataChannel('test');
    const answer = await answerer.createAnswer();
    const [client] = other.dtlsTransports;
    if (client !== undefined && options.onClientSocket !== undefined) {
      const { onClientSocket } = options;
      const start = client.start.bind(client);
      client.start = () => {
        const started = start();
        onClientSocket(client.dtls as unknown as DtlsSocketShape);
        return started;
      };
    }
    answerer.setLocalDescription(answer).catch(() => undefined);
    await offerer.setRemoteDescription({ type: 'answer', sdp: options.onAnswer?.(answer.sdp) ?? answer.sdp });
    answered.resolve();
    return peers;
  }

  /** The other peer's DTLS socket, once its handshake has begun. */
  get socket(): DtlsSocketShape {
    return this.other.dtlsTransports[0]?.dtls as unknown as DtlsSocketShape;
  }

  get connected(): boolean {
    return this.guarded.connectionState === 'connected';
  }

  /** Sends a text over the data channel and waits until the guarded peer has received it. */
  async exchange(text: string): Promise<void> {
    await new Promise<void>((resolve) => {
      if (this.toGuarded.readyState === 'open') return resolve();
      this.toGuarded.stateChanged.subscribe((state) => state === 'open' && resolve());
    });
    this.toGuarded.send(text);
    await this.until(() => this.heard.includes(text));
  }

  /** Makes the other peer send a datagram from its own socket. */
  async inject(datagram: Buffer): Promise<void> {
    await this.other.iceTransports[0]?.connection.send(datagram);
  }

  /** The address at which the guarded peer receives from the other one. */
  get guardedAddress(): readonly [host: string, port: number] {
    return this.other.iceTransports[0]?.connection.nominated?.remoteAddr as [string, number];
  }

  until(is: () => boolean): Promise<void> {
    return this.#waiters.until(is);
  }

  async close(): Promise<void> {
    await Promise.all([this.guarded.close(), this.other.close()]);
  }
}
