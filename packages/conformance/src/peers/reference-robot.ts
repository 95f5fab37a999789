/** A robot for tests that speaks as the reference system's does: signaling, channels, payload type 5. */
import { decodeBandwidth, decodeJson, referenceControlCodec, type Twist } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { MediaStreamTrack, type RTCPeerConnection, RtpHeader, RtpPacket } from 'werift';
import { Inbox } from './inbox.ts';
import { SocketPeer } from './socket-peer.ts';

export interface ReferenceRobotOptions {
  /** Leads a side's ICE candidate elsewhere, through an emulated link say. */
  lead?: (side: 'robot' | 'operator', candidate: string) => Promise<string>;
}

export class ReferenceRobot {
  id = -1;
  readonly words = new Inbox<string>();
  readonly commands = new Inbox<Twist>();
  readonly reports = new Inbox<number>();
  readonly #registered = new Inbox<number>();
  readonly #line: SocketPeer;
  readonly #lead: NonNullable<ReferenceRobotOptions['lead']>;
  #connection!: RTCPeerConnection;
  #track!: MediaStreamTrack;
  #sequence = 0;
  #timestamp = 0;

  /** The robots' port at which it is registered. */
  readonly url: string;

  private constructor(url: string, line: SocketPeer, options: ReferenceRobotOptions) {
    this.url = url;
    this.#line = line;
    this.#lead = options.lead ?? (async (_side, candidate) => candidate);
    void this.#followClient();
  }

  /** @param url the robots' port of signaling */
  static async register(
    url: string,
    name: string,
    options: ReferenceRobotOptions = {},
  ): Promise<ReferenceRobot> {
    const robot = new ReferenceRobot(url, await SocketPeer.open(url), options);
    await robot.#offer((sdpOffer) => ({ type: 'register', name, sdpOffer }));
    return robot;
  }

  /** Its offer, for others to claim. */
  get offer(): string {
    return this.#connection.localDescription?.sdp ?? '';
  }

  /** As the reference system's robot after a failure: another connection, offered under the same id. */
  async reconnect(): Promise<void> {
    const before = this.#connection;
    await this.#offer((sdpOffer) => ({ type: 'offer', robotId: this.id, sdpOffer }));
    await before.close();
  }

  signal(message: unknown): void {
    this.#line.send(message);
  }

  /** Resolves once this word came; words before it are forgotten. */
  async heard(word: 'start' | 'stop'): Promise<void> {
    await this.words.next((heard) => heard === word, undefined, `'${word}'`);
  }

  command(): Promise<Twist> {
    return this.commands.next(undefined, undefined, 'a command');
  }

  report(): Promise<number> {
    return this.reports.next(undefined, undefined, 'a report');
  }

  /** One packet each, all of one frame. */
  sendFrame(payloads: readonly Uint8Array[]): void {
    this.#timestamp += 9000;
    payloads.forEach((payload, i) => {
      const header = new RtpHeader({
        payloadType: 5,
        sequenceNumber: this.#sequence++ & 0xffff,
        timestamp: this.#timestamp >>> 0,
        marker: i === payloads.length - 1,
      });
      this.#track.writeRtp(new RtpPacket(header, Buffer.from(payload)));
    });
  }

  async close(): Promise<void> {
    await this.#line.close();
    await this.#connection.close();
  }

  async #offer(toMessage: (sdpOffer: string) => object): Promise<void> {
    const connection = createReferencePeerConnection();
    const track = new MediaStreamTrack({ kind: 'video' });
    this.#connection = connection;
    this.#track = track;
    connection.addTransceiver(track, { direction: 'sendonly' });
    const { control } = referenceChannels;
    const commands = connection.createDataChannel(control.label, { ordered: control.ordered });
    commands.onMessage.subscribe((data) => this.commands.push(decodeJson(referenceControlCodec, data)));
    connection.onDataChannel.subscribe((channel) => {
      channel.onMessage.subscribe((data) => {
        if (channel.label === referenceChannels.bandwidth.label)
          this.reports.push(decodeBandwidth(data as Buffer));
        else this.words.push(data.toString());
      });
    });
    const found: string[] = [];
    let registered = this.id >= 0;
    const tell = async (candidate: string) => {
      if (connection !== this.#connection) return;
      this.signal({ type: 'candidate', robotId: this.id, candidate: await this.#lead('robot', candidate) });
    };
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined) return;
      const text = candidate.toJSON().candidate;
      if (registered) void tell(text);
      else found.push(text);
    });
    const offer = await connection.createOffer();
    const gathered = connection.setLocalDescription(offer);
    const isNew = !registered;
    const answered = isNew
      ? this.#registered.next(undefined, undefined, 'registered')
      : Promise.resolve(this.id);
    this.signal(toMessage(offer.sdp));
    this.id = await answered;
    registered = true;
    for (const candidate of found) await tell(candidate);
    await gathered;
  }

  async #followClient(): Promise<void> {
    while (this.#line.open) {
      const message = await this.#line
        .message<{ type: string; robotId: number; sdpAnswer: string; candidate: string }>({}, 60_000)
        .catch(() => null);
      if (message?.type === 'registered') this.#registered.push(message.robotId);
      else if (message?.type === 'sdpAnswer') {
        const answer = { type: 'answer', sdp: message.sdpAnswer } as const;
        await this.#connection.setRemoteDescription(answer).catch(() => undefined);
      } else if (message?.type === 'candidate') {
        const candidate = await this.#lead('operator', message.candidate);
        await this.#connection.addIceCandidate({ candidate, sdpMLineIndex: 0 }).catch(() => undefined);
      }
    }
  }
}
