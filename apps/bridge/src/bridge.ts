/**
 * The whole bridge: signaling on one side, the connections of all robots in the middle, a page's three sockets on the
 * other.
 */

import {
  decodeJson,
  encodeJson,
  type JsonCodec,
  ProtocolError,
  type ReferenceBridgeTelemetry,
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
import { TokenBucket } from '@farpoint/timing';
import type { AssembledFrame } from './frame-assembler.ts';
import { LocalSocketServer, type Send } from './local-socket-server.ts';
import { listMessage, PageAnnouncer } from './page-announcer.ts';
import { RobotRoster, type RosterOptions } from './robot-roster.ts';

export interface BridgeOptions extends Omit<RosterOptions, 'now'> {
  /** The signaling service's port for clients. A page's initBridge can name another service. */
  signaling: string;
  host: string;
  controlPort: number;
  telemetryPort: number;
  streamingPort: number;
  allowedOrigins: readonly string[];
}

/** A frame that was sent to pages. Times are in ms on the clock that the bridge was opened with. */
export interface FrameRecord {
  frameNumber: number;
  points: number;
  expectedPoints: number;
  lastPacketMs: number;
  /** When it was handed to the sockets. */
  emittedMs: number;
  /** Number of pages that it was sent to. */
  pages: number;
}

type SignalingLine = MessageLine<ReferenceServiceToClient, ReferenceClientToService>;

/** How often silent orphans are looked for, ms. Chosen: late by a twelfth of the 3 s after which one goes. */
const EXPIRE_EVERY_MS = 250;
/** Each refused origin is told once in the log. Chosen: a page with ever new ones fills no disk. */
const MAX_REFUSED_ORIGINS = 100;
/**
 * A page with more unread bytes than this on its control socket is told nothing more until it reads. Chosen: a page that
 * lives never leaves so much.
 */
const CONTROL_BACKLOG_BYTES = 1_048_576;
/** A page with more unread bytes than this is not sent another frame. Chosen: the newest frame never waits behind many old ones. */
const STREAMING_BACKLOG_BYTES = 65_536;

export class Bridge {
  /** Number of frames sent to pages, and how long the last one was held after its last packet, ms. */
  frames = 0;
  lastEmitMs = 0;
  messagesRefused = 0;
  commandsDropped = 0;
  onFrame: ((record: FrameRecord) => void) | null = null;
  readonly #log: Logger;
  readonly #now: () => number;
  readonly roster: RobotRoster;
  readonly #refusedOrigins = new Set<string>();
  readonly #timer: NodeJS.Timeout;
  readonly #announcer = new PageAnnouncer();
  /** A reference signaling service reports changes only to the newest client, so pages may ask for the list again. */
  readonly #refreshes = new TokenBucket({ perSecond: 1, burst: 2 });
  #control!: LocalSocketServer;
  #telemetry!: LocalSocketServer;
  #streaming!: LocalSocketServer;
  #line: SignalingLine;
  #url: string;

  private constructor(options: BridgeOptions, log: Logger, now: () => number) {
    this.#log = log;
    this.#now = now;
    this.roster = new RobotRoster(
      { ...options, now },
      {
        send: (message) => this.#line.send(message),
        onFrame: (frame, lastPacketMs) => this.#toStreaming(frame, lastPacketMs),
        onRobotsChanged: () => this.#announce(),
        onSelected: (id) => {
          log.info({ robot: id }, 'robot shown');
          this.#announce();
        },
        onRobotFailed: (robot, detail) => log.warn({ robot, detail }, 'robot failed'),
      },
    );
    this.#timer = setInterval(() => this.roster.expire(now()), EXPIRE_EVERY_MS);
    this.#url = options.signaling;
    this.#line = this.#openLine();
  }

  /** @throws {Error} if a port cannot be opened */
  static async open(options: BridgeOptions, log: Logger, now: () => number): Promise<Bridge> {
    const bridge = new Bridge(options, log, now);
    const { host, allowedOrigins, controlPort, telemetryPort, streamingPort } = options;
    const common = { host, allowedOrigins, maxMessageBytes: 4096 };
    const onRefused = (origin: string) => bridge.#onRefused(origin);
    try {
      bridge.#control = await LocalSocketServer.open(
        { ...common, port: controlPort },
        {
          onOpen: (send) => bridge.#greet(send),
          onMessage: (data, send) => bridge.#onControl(data, send),
          onRefused,
        },
      );
      bridge.#telemetry = await LocalSocketServer.open(
        { ...common, port: telemetryPort },
        { onMessage: (data) => bridge.#onTelemetry(data), onRefused },
      );
      bridge.#streaming = await LocalSocketServer.open({ ...common, port: streamingPort }, { onRefused });
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

  get signalingOpen(): boolean {
    return this.#line.open;
  }

  /** Frames not sent because a page reads too slowly. */
  get framesUnsent(): number {
    return this.#streaming.unsent;
  }

  async close(): Promise<void> {
    this.#line.close();
    clearInterval(this.#timer);
    this.roster.close();
    // If a port was taken, the later ones were never opened.
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
        onMessage: (message) => this.roster.onSignaling(message),
        onDown: (detail) =>
          this.#log.warn({ url: this.#url, detail }, 'no connection to signaling; trying again'),
      },
    );
    return line;
  }

  // Pages

  #toStreaming(frame: AssembledFrame, lastPacketMs: number): void {
    const pages = this.#streaming.broadcast(frame.bytes, STREAMING_BACKLOG_BYTES, frame.release);
    const emittedMs = this.#now();
    this.frames++;
    this.lastEmitMs = emittedMs - lastPacketMs;
    const { frameNumber, points, expectedPoints } = frame;
    this.onFrame?.({ frameNumber, points, expectedPoints, lastPacketMs, emittedMs, pages });
  }

  /** A page retries again and again: log each origin once. */
  #onRefused(origin: string): void {
    if (this.#refusedOrigins.has(origin) || this.#refusedOrigins.size >= MAX_REFUSED_ORIGINS) return;
    this.#refusedOrigins.add(origin);
    this.#log.warn(
      { origin },
      `refused a page of another host; --allowed-origins ${origin} lets it in: whoever serves it may then drive`,
    );
  }

  #onControl(data: string | Uint8Array, reply: Send): void {
    const message = this.#decode<ReferencePageToBridge>(referencePageToBridgeCodec, data);
    switch (message?.type) {
      case 'initBridge':
        this.#init(message.url);
        // Whatever the address is: the reference system's page has no other way to ask.
        this.#tellRobots(reply);
        break;
      case 'updateRobots':
        this.#tellRobots(reply);
        break;
      case 'switchRobot':
        // Send it again even if the robot is already shown, because the page may be new.
        if (this.roster.selected === message.robotId) this.#greet(reply);
        else if (!this.roster.select(message.robotId)) this.#tellRobots(reply);
        break;
    }
  }

  #init(url: string): void {
    const named = signalingUrl(url);
    if (named === null || named === signalingUrl(this.#url)) return;
    this.#log.info({ url }, 'page names another signaling service');
    this.#line.close();
    this.roster.clear();
    this.#url = url;
    this.#line = this.#openLine();
  }

  #onTelemetry(data: string | Uint8Array): void {
    const message = this.#decode<ReferenceBridgeTelemetry>(referenceBridgeTelemetryCodec, data);
    if (message === null) return;
    if (this.roster.shown?.command(message.command) !== null) this.commandsDropped++;
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

  #announce(): void {
    for (const message of this.#announcer.changes(this.roster))
      this.#control?.broadcast(encodeJson(referenceBridgeToPageCodec, message), CONTROL_BACKLOG_BYTES);
  }

  /** Sends everything that a new page must know. */
  #greet(send: Send): void {
    this.#announce();
    for (const message of this.#announcer.present(this.roster))
      send(encodeJson(referenceBridgeToPageCodec, message), CONTROL_BACKLOG_BYTES);
  }

  #tellRobots(reply: Send): void {
    this.#announce();
    reply(encodeJson(referenceBridgeToPageCodec, listMessage(this.roster)), CONTROL_BACKLOG_BYTES);
    if (this.#line.open && this.#refreshes.take(this.#now())) this.#line.send({ type: 'getRobots' });
  }
}

/** Normalises an address, so that equal addresses give equal text; `null` if it is invalid. */
function signalingUrl(text: string): string | null {
  const url = URL.parse(text);
  return url !== null && /^wss?:$/.test(url.protocol) ? url.href : null;
}

/**
 * Monotonic milliseconds with the same origin in every process of this machine, so that records of several processes
 * can be joined.
 */
export function monotonicMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}
