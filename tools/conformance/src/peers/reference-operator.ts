/** An operator that behaves like the reference system's bridge: a client of signaling that answers offers. */
import { Buffer } from 'node:buffer';
import {
  encodeBandwidth,
  encodeJsonBytes,
  type ReferenceServiceToClient,
  referenceControlCodec,
  type Twist,
} from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { prepareSockets, tapRtp } from '@farpoint/webrtc';
import { helloAtOnce } from '@farpoint/webrtc/testing';
import type { RTCDataChannel, RTCPeerConnection } from 'werift';
import { UnreachableError } from '../reach.ts';
import { Inbox } from './inbox.ts';
import { OfferBoard, type OpenOffer } from './offer-board.ts';
import { SocketPeer } from './socket-peer.ts';

/** The reference system's robot needs about 6 s. */
const OFFERS_AGAIN_WITHIN_MS = 15_000;

export class ReferenceOperator {
  readonly offer: string;
  readonly robotId: number;
  /** Decrypted RTP packets, including headers. */
  readonly packets = new Inbox<Uint8Array>();
  /** Also called for each packet. */
  onPacket: ((packet: Uint8Array) => void) | null = null;
  /** Labels and options of the channels that the robot opened. */
  readonly robotChannels: { label: string; ordered: boolean; reliable: boolean }[] = [];
  readonly #line: SocketPeer;
  readonly #connection: RTCPeerConnection;
  readonly #bandwidth: RTCDataChannel;
  readonly #words: RTCDataChannel;
  readonly #channels = new Inbox<RTCDataChannel>();
  /** Offers made since this operator connected. */
  readonly #laterOffers = new Inbox<OpenOffer>();
  #control: RTCDataChannel | null = null;

  private constructor(line: SocketPeer, { robotId, sdpOffer }: OpenOffer) {
    this.#line = line;
    this.robotId = robotId;
    this.offer = sdpOffer;
    const connection = createReferencePeerConnection();
    this.#connection = connection;
    const { bandwidth, words } = referenceChannels;
    this.#bandwidth = connection.createDataChannel(bandwidth.label, { ordered: true });
    this.#words = connection.createDataChannel(words.label, {
      ordered: true,
      maxRetransmits: words.maxRetransmits,
    });
    connection.onDataChannel.subscribe((channel) => {
      const { label, ordered, maxRetransmits, maxPacketLifeTime } = channel;
      this.robotChannels.push({
        label,
        ordered,
        reliable: maxRetransmits == null && maxPacketLifeTime == null,
      });
      this.#channels.push(channel);
    });
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined) return;
      prepareSockets(connection);
      line.send({ type: 'candidate', robotId, candidate: candidate.toJSON().candidate });
    });
    connection.connectionStateChange.subscribe((state) => {
      const dtls = connection.dtlsTransports[0];
      if (state !== 'connected' || dtls === undefined) return;
      tapRtp(dtls, (packet) => {
        const copy = new Uint8Array(packet);
        this.packets.push(copy);
        this.onPacket?.(copy);
      });
    });
  }

  /**
   * Answers the robot with this name, waiting for it if necessary, and each of its later offers. Resolves when the
   * channels of a connection are open, the robot's and ours.
   *
   * @param url the clients' port of signaling
   * @param timeoutMs our robot makes another offer 20 s after an answer that came to nothing
   * @throws {UnreachableError} if no robot with this name has registered
   */
  static async connect(url: string, name: string, timeoutMs = 30_000): Promise<ReferenceOperator> {
    const line = await SocketPeer.open(url);
    const board = new OfferBoard(name);
    const attempts = new Map<number, ReferenceOperator>();
    const opened = new Inbox<ReferenceOperator>();
    const answer = async (offer: OpenOffer) => {
      const before = attempts.get(offer.robotId);
      const operator = new ReferenceOperator(line, offer);
      attempts.set(offer.robotId, operator);
      await before?.disconnect();
      // If this connection fails, another offer may come.
      await operator.#answer(offer.candidates, timeoutMs).then(
        () => opened.push(operator),
        () => undefined,
      );
    };
    let chosen: ReferenceOperator | null = null;
    const follow = async () => {
      for (;;) {
        const message = await line.message<ReferenceServiceToClient>({}, 60_000).catch(() => null);
        if (message === null) return;
        if (message.type === 'candidate') void attempts.get(message.robotId)?.addCandidate(message.candidate);
        else
          for (const offer of board.read(message)) {
            if (chosen === null) void answer(offer);
            else chosen.#laterOffers.push(offer);
          }
      }
    };
    line.send({ type: 'getRobots' });
    void follow();
    try {
      chosen = await Promise.race([
        opened.next(undefined, timeoutMs, `robot '${name}', connected,`),
        line.closed.then(() => Promise.reject(new Error('signaling closed the connection'))),
      ]);
      return chosen;
    } catch (error) {
      const absent = line.open ? absence(url, name, board) : null;
      await line.close();
      throw absent ?? error;
    } finally {
      for (const attempt of attempts.values()) if (attempt !== chosen) await attempt.disconnect();
    }
  }

  get state(): string {
    return this.#connection.connectionState;
  }

  say(word: string | Uint8Array): void {
    this.#words.send(typeof word === 'string' ? word : Buffer.from(word));
  }

  report(bitsPerSecond: number): void {
    this.#bandwidth.send(Buffer.from(encodeBandwidth(bitsPerSecond)));
  }

  command(twist: Twist): void {
    this.sendControl(encodeJsonBytes(referenceControlCodec, twist));
  }

  sendControl(data: string | Uint8Array): void {
    this.#control?.send(typeof data === 'string' ? data : Buffer.from(data));
  }

  sendBandwidth(data: string | Uint8Array): void {
    this.#bandwidth.send(typeof data === 'string' ? data : Buffer.from(data));
  }

  async close(): Promise<void> {
    await this.#line.close();
    await this.disconnect();
  }

  /**
   * Leaves the robot, and leaves signaling once the robot offers again. Otherwise the next operator would find the old
   * offer listed, and the reference system's robot takes an answer to that for one to its next offer.
   */
  async leave(): Promise<void> {
    this.#laterOffers.clear();
    await this.disconnect();
    await this.#laterOffers.next(undefined, OFFERS_AGAIN_WITHIN_MS).catch(() => undefined);
    await this.#line.close();
  }

  /** Leaves the robot, but not signaling. */
  async disconnect(): Promise<void> {
    await this.#connection.close();
  }

  async #answer(candidates: readonly string[], timeoutMs: number): Promise<void> {
    const connection = this.#connection;
    await connection.setRemoteDescription({ type: 'offer', sdp: this.offer });
    // Like the reference system's own stack.
    helloAtOnce(connection);
    const answer = await connection.createAnswer();
    this.#line.send({ type: 'answer', robotId: this.robotId, sdpAnswer: answer.sdp });
    const gathered = connection.setLocalDescription(answer);
    for (const candidate of candidates) await this.addCandidate(candidate);
    await gathered;
    const control = await this.#channels.next(
      ({ label }) => label === referenceChannels.control.label,
      timeoutMs,
      'the robot’s control channel',
    );
    this.#control = control;
    for (const channel of [control, this.#words, this.#bandwidth]) await opened(channel, timeoutMs);
  }

  /** Ignores an unusable candidate. */
  async addCandidate(candidate: string): Promise<void> {
    await this.#connection.addIceCandidate({ candidate, sdpMLineIndex: 0 }).catch(() => undefined);
  }
}

async function opened(channel: RTCDataChannel, timeoutMs: number): Promise<void> {
  const inbox = new Inbox<string>();
  channel.stateChanged.subscribe((state) => inbox.push(state));
  if (channel.readyState !== 'open')
    await inbox.next((state) => state === 'open', timeoutMs, `channel '${channel.label}'`);
}

/** Why there is no robot to connect to; `null` if there is one. */
function absence(url: string, name: string, board: OfferBoard): UnreachableError | null {
  if (!board.listed)
    return new UnreachableError(
      `${url} (--client) does not answer getRobots; check that it is the clients’ port of the reference system’s signaling`,
    );
  if (board.knows) return null;
  const others = [...board.others].map((other) => `‘${other}’`).join(', ');
  return new UnreachableError(
    `no robot ‘${name}’ (--name) is registered at ${url} (--client); check that it runs and has connected there, and its name${others === '' ? '' : `: there are ${others}`}`,
  );
}
