/**
 * Stand-in for the reference system's released robot, with its actual behaviour, including defects:
 *
 * - one socket to signaling for its whole life, never reopened; one peer connection at a time; its id is 0 until it is
 *   told another;
 * - its offer lists the stack's other payload types beside 5, and its attribute lines end with a blank;
 * - candidates wait for the answer, and are sent once more when it has connected;
 * - any answer that arrives on its socket is set on the present connection;
 * - about 6 s after its operator has left it offers again: by `offer` under its id or, because 0 counts as no id, by
 *   another `register` on the same socket if it is robot 0;
 * - `start` and `stop` switch the stream; the word outlives the connection: a robot that was started streams to the
 *   next operator without being asked;
 * - frames of whole packets count from 0 for each connection, each sent as a burst; the timestamp advances by one
 *   second per frame;
 * - commands are obeyed as they arrive; `linear.z ≠ 0` makes the next frame green and is no motion.
 */
import type { Buffer } from 'node:buffer';
import { decodeBandwidth, LATENCY_TEST_COLOUR, POINTS_PER_PACKET, type Twist } from '@farpoint/protocol';
import { knownFrame } from '../frames.ts';
import { Inbox } from '../peers/inbox.ts';
import { OfferingConnection } from '../peers/offering-connection.ts';
import { SocketPeer } from '../peers/socket-peer.ts';

export interface ReleasedRobotOptions {
  /** The name under which it registers; the released robot always uses the default. */
  name?: string;
  /** Time from its operator's leaving to the next offer, ms: the released one needs about 6 s. */
  offerAgainMs?: number;
  points?: number;
  framesPerSecond?: number;
}

type Message = { type: string; robotId: number; sdpAnswer: string; candidate: string };

export class ReleasedRobot {
  id = 0;
  readonly commands = new Inbox<Twist>();
  readonly reports = new Inbox<number>();
  /** Connections that it has offered, counted from 1. */
  readonly offered = new Inbox<number>();
  offers = 0;
  readonly #options: Required<ReleasedRobotOptions>;
  readonly #line: SocketPeer;
  readonly #timer: NodeJS.Timeout;
  #connection!: OfferingConnection;
  #candidates: string[] = [];
  #answered = false;
  #told = false;
  #started = false;
  #greenWanted = false;
  #frame = 0;
  #again: NodeJS.Timeout | null = null;

  private constructor(line: SocketPeer, options: ReleasedRobotOptions) {
    this.#line = line;
    this.#options = { name: 'robot', offerAgainMs: 6000, points: 300, framesPerSecond: 20, ...options };
    this.#timer = setInterval(() => this.#stream(), 1000 / this.#options.framesPerSecond);
    void this.#follow();
  }

  /** @param url the robots' port of signaling */
  static async start(url: string, options: ReleasedRobotOptions = {}): Promise<ReleasedRobot> {
    const robot = new ReleasedRobot(await SocketPeer.open(url), options);
    await robot.#offer();
    return robot;
  }

  async stop(): Promise<void> {
    clearInterval(this.#timer);
    if (this.#again !== null) clearTimeout(this.#again);
    await this.#line.close();
    await this.#connection.close();
  }

  async #offer(): Promise<void> {
    const isNew = this.id === 0;
    this.#candidates = [];
    this.#answered = false;
    this.#told = false;
    this.#frame = 0;
    this.offers++;
    const connection = new OfferingConnection({
      onCandidate: (candidate) => {
        this.#candidates.push(candidate);
        if (this.#answered) this.#tell(candidate);
      },
      onCommand: (data) => this.#onCommand(data),
      onBandwidth: (data) => {
        if (typeof data !== 'string' && data.length === 4) this.reports.push(decodeBandwidth(data));
      },
      onWord: (word) => {
        if (word === 'start' || word === 'stop') this.#started = word === 'start';
      },
      onLost: () => {
        this.#again ??= setTimeout(() => {
          this.#again = null;
          void connection.close().then(() => this.#offer());
        }, this.#options.offerAgainMs);
      },
    });
    this.#connection = connection;
    const sdpOffer = asReleased(await connection.offer());
    this.#line.send(
      isNew
        ? { type: 'register', name: this.#options.name, sdpOffer }
        : { type: 'offer', robotId: this.id, sdpOffer },
    );
    this.offered.push(this.offers);
  }

  async #follow(): Promise<void> {
    while (this.#line.open) {
      const message = await this.#line.message<Message>({}, 60_000).catch(() => null);
      if (message?.type === 'registered') this.id = message.robotId;
      else if (message?.type === 'candidate') await this.#connection.addCandidate(message.candidate);
      else if (message?.type === 'sdpAnswer') await this.#onAnswer(message.sdpAnswer);
    }
  }

  async #onAnswer(sdpAnswer: string): Promise<void> {
    try {
      await this.#connection.answer(sdpAnswer);
    } catch {
      return;
    }
    this.#answered = true;
    for (const candidate of this.#candidates) this.#tell(candidate);
  }

  #tell(candidate: string): void {
    this.#line.send({ type: 'candidate', robotId: this.id, candidate });
  }

  /** Unreadable commands are ignored; missing components are 0. */
  #onCommand(data: string | Buffer): void {
    let read: Partial<Twist> | null;
    try {
      read = JSON.parse(data.toString()) as Partial<Twist> | null;
    } catch {
      return;
    }
    const zero = { x: 0, y: 0, z: 0 };
    const twist = { linear: { ...zero, ...read?.linear }, angular: { ...zero, ...read?.angular } };
    if (twist.linear.z !== 0) this.#greenWanted = true;
    else this.commands.push(twist);
  }

  #stream(): void {
    const { connected } = this.#connection;
    if (connected && !this.#told) {
      this.#told = true;
      for (const candidate of this.#candidates) this.#tell(candidate);
    }
    if (!connected || !this.#started) return;
    const payloads = knownFrame(this.#frame++, this.#options.points);
    if (this.#greenWanted) for (const payload of payloads) paintGreen(payload);
    this.#greenWanted = false;
    this.#connection.sendFrame(payloads, 90_000);
  }
}

function paintGreen(payload: Uint8Array): void {
  const view = new DataView(payload.buffer, payload.byteOffset + 16 + 6 * POINTS_PER_PACKET);
  for (let i = 0; i < POINTS_PER_PACKET; i++) view.setUint16(2 * i, LATENCY_TEST_COLOUR, true);
}

/** The same offer as written by the released robot's stack. */
function asReleased(sdp: string): string {
  return sdp
    .replace(/^(m=video .*)\r$/m, '$1 96 97\r')
    .replace(
      /^(a=rtpmap:5 .*)\r$/m,
      '$1\r\na=rtpmap:96 VP8/90000\r\na=rtcp-fb:96 nack \r\na=rtpmap:97 rtx/90000\r\na=fmtp:97 apt=96\r',
    )
    .replace(/^(a=rtcp-fb:5 \S+)\r$/gm, '$1 \r');
}
