/** A robot for tests that behaves like the reference system's: signaling, channels, payload type 5. */
import { decodeBandwidth, decodeJson, referenceControlCodec, type Twist } from '@farpoint/protocol';
import { Inbox } from './inbox.ts';
import { OfferingConnection } from './offering-connection.ts';
import { SocketPeer } from './socket-peer.ts';

export interface ReferenceRobotOptions {
  /** Replaces a side's ICE candidate, for example to route it through an emulated link. */
  lead?: (side: 'robot' | 'operator', candidate: string) => Promise<string>;
}

export class ReferenceRobot {
  id = -1;
  readonly words = new Inbox<string>();
  readonly commands = new Inbox<Twist>();
  readonly reports = new Inbox<number>();
  /** The robots' port of the signaling at which it is registered. */
  readonly url: string;
  readonly #registered = new Inbox<number>();
  readonly #line: SocketPeer;
  readonly #lead: NonNullable<ReferenceRobotOptions['lead']>;
  #connection!: OfferingConnection;
  #offer = '';

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
    await robot.#connect((sdpOffer) => ({ type: 'register', name, sdpOffer }));
    return robot;
  }

  /** Its offer, for others to claim. */
  get offer(): string {
    return this.#offer;
  }

  /** Like the reference system's robot after a failure: a new connection, offered under the same id. */
  async reconnect(): Promise<void> {
    const before = this.#connection;
    await this.#connect((sdpOffer) => ({ type: 'offer', robotId: this.id, sdpOffer }));
    await before.close();
  }

  signal(message: unknown): void {
    this.#line.send(message);
  }

  /** Resolves once an operator has connected and both sides may send. */
  ready(): Promise<void> {
    return this.#connection.ready();
  }

  /** Resolves once this word has arrived; discards earlier words. */
  async heard(word: 'start' | 'stop'): Promise<void> {
    await this.words.next((heard) => heard === word, undefined, `'${word}'`);
  }

  command(): Promise<Twist> {
    return this.commands.next(undefined, undefined, 'a command');
  }

  report(): Promise<number> {
    return this.reports.next(undefined, undefined, 'a report');
  }

  /** Sends one packet per payload, all of one frame. */
  sendFrame(payloads: readonly Uint8Array[]): void {
    this.#connection.sendFrame(payloads);
  }

  async close(): Promise<void> {
    await this.#line.close();
    await this.#connection.close();
  }

  async #connect(toMessage: (sdpOffer: string) => object): Promise<void> {
    const found: string[] = [];
    let registered = this.id >= 0;
    const tell = async (candidate: string) => {
      if (connection !== this.#connection) return;
      this.signal({ type: 'candidate', robotId: this.id, candidate: await this.#lead('robot', candidate) });
    };
    const connection: OfferingConnection = new OfferingConnection({
      onCandidate: (candidate) => {
        if (registered) void tell(candidate);
        else found.push(candidate);
      },
      onCommand: (data) => this.commands.push(decodeJson(referenceControlCodec, data)),
      onBandwidth: (data) => this.reports.push(decodeBandwidth(data as Buffer)),
      onWord: (word) => this.words.push(word),
    });
    this.#connection = connection;
    this.#offer = await connection.offer();
    this.signal(toMessage(this.#offer));
    if (!registered) this.id = await this.#registered.next(undefined, undefined, 'registered');
    registered = true;
    for (const candidate of found) await tell(candidate);
  }

  async #followClient(): Promise<void> {
    while (this.#line.open) {
      const message = await this.#line
        .message<{ type: string; robotId: number; sdpAnswer: string; candidate: string }>({}, 60_000)
        .catch(() => null);
      if (message?.type === 'registered') this.#registered.push(message.robotId);
      else if (message?.type === 'sdpAnswer')
        await this.#connection.answer(message.sdpAnswer).catch(() => undefined);
      else if (message?.type === 'candidate')
        await this.#connection.addCandidate(await this.#lead('operator', message.candidate));
    }
  }
}
