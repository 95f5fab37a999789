/** The bridge put together: signaling on one side, every robot's connection in the middle, a page's three sockets on the other. */
import {
  decodeJson,
  encodeJson,
  type JsonCodec,
  ProtocolError,
  type ReferenceBridgeTelemetry,
  type ReferenceBridgeToPage,
  type ReferenceClientToService,
  type ReferencePageToBridge,
  type ReferenceServiceToClient,
  referenceBridgeTelemetryCodec,
  referenceBridgeToPageCodec,
  referenceClientToServiceCodec,
  referencePageToBridgeCodec,
  referenceServiceToClientCodec,
} from '@farpoint/protocol';
import { MessageLine } from '@farpoint/reference-profile';
import type { Logger } from '@farpoint/service';
import { LocalSocketServer } from './local-socket-server.ts';
import { RobotConnection, type RobotConnectionOptions } from './robot-connection.ts';
import { RobotSelection } from './robot-selection.ts';

export interface BridgeOptions extends Omit<RobotConnectionOptions, 'now'> {
  /** Client port of the signaling service; a page's initBridge names another. */
  signaling: string;
  host: string;
  controlPort: number;
  telemetryPort: number;
  streamingPort: number;
  allowedOrigins: readonly string[];
  maxRobots: number;
}

/** A frame that was given to pages. Times are the clock's that the bridge was opened with, ms. */
export interface FrameRecord {
  frameNumber: number;
  points: number;
  expectedPoints: number;
  lastPacketMs: number;
  /** Handed to the sockets. */
  emittedMs: number;
  /** Pages it went to. */
  pages: number;
}

interface Robot {
  readonly name: string;
  offer: string;
  connection: RobotConnection;
}

type SignalingLine = MessageLine<ReferenceServiceToClient, ReferenceClientToService>;

const CONTROL_BACKLOG_BYTES = 1_048_576;
/** A page that has not read the frame before is not sent another. */
const STREAMING_BACKLOG_BYTES = 65_536;

export class Bridge {
  /** Frames given to pages, and for how long the last one was held after its last packet, ms. */
  frames = 0;
  lastEmitMs = 0;
  robotsFailed = 0;
  robotsRefused = 0;
  messagesRefused = 0;
  commandsDropped = 0;
  onFrame: ((record: FrameRecord) => void) | null = null;
  readonly #options: BridgeOptions;
  readonly #log: Logger;
  readonly #now: () => number;
  readonly #robots = new Map<number, Robot>();
  readonly #selection: RobotSelection;
  #control!: LocalSocketServer;
  #telemetry!: LocalSocketServer;
  #streaming!: LocalSocketServer;
  #line: SignalingLine;
  #url: string;

  private constructor(options: BridgeOptions, log: Logger, now: () => number) {
    this.#options = options;
    this.#log = log;
    this.#now = now;
    this.#selection = new RobotSelection({
      onSwitch: (id, word) => {
        const connection = this.#robots.get(id)?.connection;
        if (connection === undefined) return;
        connection.shown = word === 'start';
        if (word === 'stop') connection.assembler.clear();
        connection.tell(word);
      },
      onSelected: (id) => {
        log.info({ robot: id }, 'robot shown');
        if (id !== null) this.#toPages({ type: 'switchedRobot', robotId: id });
      },
    });
    this.#url = options.signaling;
    this.#line = this.#openLine();
  }

  /** @throws {Error} where a port cannot be listened on */
  static async open(options: BridgeOptions, log: Logger, now: () => number): Promise<Bridge> {
    const bridge = new Bridge(options, log, now);
    const { host, allowedOrigins, controlPort, telemetryPort, streamingPort } = options;
    const common = { host, allowedOrigins, maxMessageBytes: 4096 };
    try {
      bridge.#control = await LocalSocketServer.open(
        { ...common, port: controlPort },
        { onMessage: (data) => bridge.#onControl(data) },
      );
      bridge.#telemetry = await LocalSocketServer.open(
        { ...common, port: telemetryPort },
        { onMessage: (data) => bridge.#onTelemetry(data) },
      );
      bridge.#streaming = await LocalSocketServer.open({ ...common, port: streamingPort }, {});
    } catch (error) {
      await bridge.close();
      throw error;
    }
    return bridge;
  }

  get ports(): { control: number; telemetry: number; streaming: number } {
    return {
      control: this.#control.port,
      telemetry: this.#telemetry.port,
      streaming: this.#streaming.port,
    };
  }

  get robots(): number {
    return this.#robots.size;
  }

  get signalingOpen(): boolean {
    return this.#line.open;
  }

  /** Frames not sent because a page reads too slowly. */
  get framesUnsent(): number {
    return this.#streaming.unsent;
  }

  async close(): Promise<void> {
    this.#line.close();
    for (const { connection } of this.#robots.values()) connection.close();
    this.#robots.clear();
    // Where a port was taken the later ones were never opened.
    for (const server of [this.#control, this.#telemetry, this.#streaming] as (
      | LocalSocketServer
      | undefined
    )[])
      await server?.close();
  }

  // Signaling

  #openLine(): SignalingLine {
    const line: SignalingLine = new MessageLine(
      {
        url: this.#url,
        incoming: referenceServiceToClientCodec,
        outgoing: referenceClientToServiceCodec,
      },
      {
        onOpen: () => line.send({ type: 'getRobots' }),
        onMessage: (message) => this.#onSignaling(message),
        onDown: (detail) => this.#log.warn({ url: this.#url, detail }, 'no line to signaling'),
      },
    );
    return line;
  }

  #onSignaling(message: ReferenceServiceToClient): void {
    switch (message.type) {
      case 'robots': {
        const offers = new Map(message.robots.map(({ id, sdpOffer }) => [id, sdpOffer]));
        // After a restart of the service the same id may be another robot.
        for (const [id, robot] of [...this.#robots]) if (offers.get(id) !== robot.offer) this.#remove(id);
        for (const robot of message.robots)
          this.#add(robot.id, robot.name, robot.sdpOffer, robot.robotCandidates);
        break;
      }
      case 'register':
        this.#remove(message.robot.id);
        this.#add(
          message.robot.id,
          message.robot.name,
          message.robot.sdpOffer,
          message.robot.robotCandidates,
        );
        break;
      case 'offer': {
        const robot = this.#robots.get(message.robotId);
        if (robot === undefined) {
          // It has failed, or came without an offer: the list says its name.
          this.#line.send({ type: 'getRobots' });
          break;
        }
        robot.offer = message.sdpOffer;
        void this.#answer(message.robotId, robot);
        break;
      }
      case 'candidate':
        void this.#robots.get(message.robotId)?.connection.addCandidate(message.candidate);
        break;
      case 'deregister':
        if (message.robotId !== undefined) this.#remove(message.robotId);
        break;
      case 'deregistered':
        this.#remove(message.robotId);
        break;
    }
  }

  #add(id: number, name: string, offer: string | null, candidates: readonly string[]): void {
    if (offer === null || this.#robots.has(id)) return;
    if (this.#robots.size >= this.#options.maxRobots) {
      this.robotsRefused++;
      return;
    }
    const connection = new RobotConnection(
      { ...this.#options, now: this.#now },
      {
        onCandidate: (candidate) => this.#line.send({ type: 'candidate', robotId: id, candidate }),
        onReady: () => connection.tell(this.#selection.wordFor(id)),
        onFrame: (frame, lastPacketMs) => {
          const pages = this.#streaming.broadcast(frame.bytes, STREAMING_BACKLOG_BYTES, frame.release);
          const emittedMs = this.#now();
          this.frames++;
          this.lastEmitMs = emittedMs - lastPacketMs;
          const { frameNumber, points, expectedPoints } = frame;
          this.onFrame?.({ frameNumber, points, expectedPoints, lastPacketMs, emittedMs, pages });
        },
        onFailed: (detail) => {
          this.robotsFailed++;
          this.#log.warn({ robot: id, detail }, 'robot failed');
          if (this.#robots.get(id)?.connection === connection) this.#remove(id);
        },
      },
    );
    const robot: Robot = { name, offer, connection };
    this.#robots.set(id, robot);
    this.#selection.add(id, name);
    this.#toPagesRobots();
    void this.#answer(id, robot);
    for (const candidate of candidates) void connection.addCandidate(candidate);
  }

  async #answer(id: number, robot: Robot): Promise<void> {
    const sdpAnswer = await robot.connection.answer(robot.offer);
    if (sdpAnswer !== null) this.#line.send({ type: 'answer', robotId: id, sdpAnswer });
  }

  #remove(id: number): void {
    const robot = this.#robots.get(id);
    if (robot === undefined) return;
    this.#robots.delete(id);
    robot.connection.close();
    this.#selection.remove(id);
    this.#toPagesRobots();
  }

  // Pages

  #onControl(data: string | Uint8Array): void {
    const message = this.#decode<ReferencePageToBridge>(referencePageToBridgeCodec, data);
    switch (message?.type) {
      case 'initBridge':
        this.#init(message.url);
        break;
      case 'updateRobots':
        this.#toPagesRobots();
        break;
      case 'switchRobot':
        // Told again where it is shown already: the page may be a new one.
        if (this.#selection.selected === message.robotId)
          this.#toPages({ type: 'switchedRobot', robotId: message.robotId });
        else this.#selection.select(message.robotId);
        break;
    }
  }

  #init(url: string): void {
    if (url === this.#url || !/^wss?:$/.test(URL.parse(url)?.protocol ?? '')) return;
    this.#log.info({ url }, 'page names another signaling service');
    this.#line.close();
    for (const id of [...this.#robots.keys()]) this.#remove(id);
    this.#url = url;
    this.#line = this.#openLine();
  }

  #onTelemetry(data: string | Uint8Array): void {
    const message = this.#decode<ReferenceBridgeTelemetry>(referenceBridgeTelemetryCodec, data);
    if (message === null) return;
    const robot = this.#robots.get(this.#selection.selected ?? -1);
    if (robot === undefined || robot.connection.command(message.command) !== null) this.commandsDropped++;
  }

  #decode<T>(codec: JsonCodec<T>, data: string | Uint8Array): T | null {
    try {
      return decodeJson(codec, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.messagesRefused++;
      return null;
    }
  }

  #toPagesRobots(): void {
    const { robots } = this.#selection;
    this.#toPages({ type: 'updateRobots', robots: robots.length === 0 ? null : robots });
  }

  #toPages(message: ReferenceBridgeToPage): void {
    this.#control?.broadcast(encodeJson(referenceBridgeToPageCodec, message), CONTROL_BACKLOG_BYTES);
  }
}
