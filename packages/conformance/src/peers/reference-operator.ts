/** An operator that speaks as the reference system's bridge does: a client of signaling, the one who answers. */
import { Buffer } from 'node:buffer';
import { encodeBandwidth, encodeJsonBytes, referenceControlCodec, type Twist } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels, tapRtp } from '@farpoint/reference-profile';
import { prepareSockets } from '@farpoint/webrtc';
import type { RTCDataChannel, RTCPeerConnection } from 'werift';
import { Inbox } from './inbox.ts';
import { SocketPeer } from './socket-peer.ts';

interface ListedRobot {
  id: number;
  name: string;
  sdpOffer: string | null;
  robotCandidates: string[];
}

export class ReferenceOperator {
  readonly offer: string;
  readonly robotId: number;
  /** Decrypted RTP packets, headers included. */
  readonly packets = new Inbox<Uint8Array>();
  /** Called with each as well. */
  onPacket: ((packet: Uint8Array) => void) | null = null;
  /** Labels and options of the channels that the robot opened. */
  readonly robotChannels: { label: string; ordered: boolean; reliable: boolean }[] = [];
  readonly #line: SocketPeer;
  readonly #connection: RTCPeerConnection;
  readonly #bandwidth: RTCDataChannel;
  readonly #words: RTCDataChannel;
  readonly #channels = new Inbox<RTCDataChannel>();
  /** The robot's registration ended. */
  readonly #left = new Inbox<string>();
  #control: RTCDataChannel | null = null;
  #open = false;

  private constructor(line: SocketPeer, robot: ListedRobot) {
    this.#line = line;
    this.robotId = robot.id;
    this.offer = robot.sdpOffer ?? '';
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
      line.send({ type: 'candidate', robotId: robot.id, candidate: candidate.toJSON().candidate });
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
   * Answers the robot of this name, waiting for it where it is not there yet, and anew where it registers anew meanwhile;
   * resolves when its channel and ours are open.
   *
   * @param url the clients' port of signaling
   */
  static async connect(url: string, name: string, timeoutMs = 15_000): Promise<ReferenceOperator> {
    const deadline = performance.now() + timeoutMs;
    for (;;) {
      const line = await SocketPeer.open(url);
      line.send({ type: 'getRobots' });
      const leftMs = deadline - performance.now();
      const robot = await findRobot(line, name, leftMs);
      const operator = new ReferenceOperator(line, robot);
      try {
        await Promise.race([operator.#answer(robot, leftMs), operator.#left.next(undefined, leftMs)]);
        if (operator.#open) return operator;
      } catch (error) {
        await operator.close();
        throw error;
      }
      await operator.close();
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
    await this.#connection.close();
  }

  async #answer(robot: ListedRobot, timeoutMs: number): Promise<void> {
    const connection = this.#connection;
    await connection.setRemoteDescription({ type: 'offer', sdp: this.offer });
    const answer = await connection.createAnswer();
    this.#line.send({ type: 'answer', robotId: robot.id, sdpAnswer: answer.sdp });
    const gathered = connection.setLocalDescription(answer);
    for (const candidate of robot.robotCandidates) await this.#addCandidate(candidate);
    void this.#followRobot();
    await gathered;
    const control = await this.#channels.next(
      ({ label }) => label === referenceChannels.control.label,
      timeoutMs,
      'the robot’s control channel',
    );
    this.#control = control;
    for (const channel of [control, this.#words, this.#bandwidth]) await opened(channel, timeoutMs);
    this.#open = true;
  }

  async #followRobot(): Promise<void> {
    for (;;) {
      const next = await this.#line
        .message<{ type: string; candidate: string }>({ robotId: this.robotId }, 60_000)
        .catch(() => null);
      if (next === null) return;
      if (next.type === 'candidate') await this.#addCandidate(next.candidate);
      if (next.type === 'deregistered') this.#left.push('left');
    }
  }

  async #addCandidate(candidate: string): Promise<void> {
    await this.#connection.addIceCandidate({ candidate, sdpMLineIndex: 0 }).catch(() => undefined);
  }
}

async function findRobot(line: SocketPeer, name: string, timeoutMs: number): Promise<ListedRobot> {
  let found: ListedRobot | undefined;
  await line.inbox.next(
    (data) => {
      if (typeof data !== 'string') return false;
      const message = JSON.parse(data) as { type: string; robots?: ListedRobot[]; robot?: ListedRobot };
      const listed = message.type === 'robots' ? (message.robots ?? []) : [];
      if (message.type === 'register' && message.robot !== undefined) listed.push(message.robot);
      found = listed.find((robot) => robot.name === name && robot.sdpOffer !== null);
      return found !== undefined;
    },
    timeoutMs,
    `robot '${name}'`,
  );
  return found as ListedRobot;
}

async function opened(channel: RTCDataChannel, timeoutMs: number): Promise<void> {
  const inbox = new Inbox<string>();
  channel.stateChanged.subscribe((state) => inbox.push(state));
  if (channel.readyState !== 'open')
    await inbox.next((state) => state === 'open', timeoutMs, `channel '${channel.label}'`);
}
