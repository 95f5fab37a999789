/**
 * Stand-in for the reference system's released bridge, with its actual behaviour, including defects:
 *
 * - three WebSocket servers, pages of any origin;
 * - no signaling before the first `initBridge`; each opens another socket to the address it names, and the previous
 *   socket stays open, unread;
 * - every robot that is listed or registers is answered; candidates in a list are not used, only later ones;
 * - a list replaces the known robots; every change goes to every page, an empty list as `null`; connections of robots
 *   that have left stay open;
 * - another offer of a robot is set on the existing connection;
 * - robot 0 counts as shown from the start; `switchRobot` shows any number, sends `start` or `stop` to every robot, and
 *   answers `switchedRobot`: a word to a channel that is not open yet is lost;
 * - a command for a robot whose channel is not open breaks the handler: the page's telemetry socket ends;
 * - an unreadable offer ends the program.
 */
import { Buffer } from 'node:buffer';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { prepareSockets, tapRtp } from '@farpoint/webrtc';
import type { RTCDataChannel, RTCPeerConnection } from 'werift';
import { WebSocket, type WebSocketServer } from 'ws';
import { Inbox } from '../peers/inbox.ts';
import { closePlainServer, openPlainServer, plainServerUrl } from './plain-socket-server.ts';
import { ReleasedFrames } from './released-frames.ts';
import type { BridgeSockets } from './released-page.ts';

interface ListedRobot {
  id: number;
  name: string;
  sdpOffer: string | null;
}

interface Robot {
  connection: RTCPeerConnection;
  words: RTCDataChannel;
  bandwidth: RTCDataChannel;
  control: RTCDataChannel | null;
  frames: ReleasedFrames;
}

type FromSignaling = {
  type: string;
  robots: ListedRobot[];
  robot: ListedRobot;
  robotId: number;
  sdpOffer: string;
  candidate: string;
};
type FromPage = { type?: unknown; url: string; robotId: unknown; command: object };

export class ReleasedBridge {
  /** Why the program ended; `null` while it runs. */
  death: string | null = null;
  readonly sockets: BridgeSockets;
  readonly #control: WebSocketServer;
  readonly #telemetry: WebSocketServer;
  readonly #streaming: WebSocketServer;
  readonly #listed = new Map<number, string>();
  readonly #robots = new Map<number, Robot>();
  /** Includes connections that it has forgotten. */
  readonly #connections: RTCPeerConnection[] = [];
  readonly #lines: WebSocket[] = [];
  readonly #opened = new Inbox<true>();
  #selected = 0;
  #handling: Promise<void> = Promise.resolve();

  private constructor(servers: readonly WebSocketServer[]) {
    const [control, telemetry, streaming] = servers as [WebSocketServer, WebSocketServer, WebSocketServer];
    this.#control = control;
    this.#telemetry = telemetry;
    this.#streaming = streaming;
    this.sockets = {
      control: plainServerUrl(control),
      telemetry: plainServerUrl(telemetry),
      streaming: plainServerUrl(streaming),
    };
    for (const server of servers)
      server.on('connection', (socket) => socket.on('error', () => socket.terminate()));
    control.on('connection', (socket) => socket.on('message', (data) => this.#onControl(String(data))));
    telemetry.on('connection', (socket) =>
      socket.on('message', (data) => {
        if (!this.#onTelemetry(String(data))) socket.terminate();
      }),
    );
  }

  /** Starts it on free ports of this machine. */
  static async start(): Promise<ReleasedBridge> {
    return new ReleasedBridge(await Promise.all([openPlainServer(), openPlainServer(), openPlainServer()]));
  }

  /** For tests: resolves once a robot with this name is connected, so that it receives `start` and commands. */
  async ready(name: string): Promise<void> {
    for (;;) {
      for (const [id, listed] of this.#listed) {
        const robot = this.#robots.get(id);
        if (listed === name && robot?.words.readyState === 'open' && robot.control?.readyState === 'open')
          return;
      }
      await this.#opened.next(undefined, undefined, `robot '${name}', connected,`);
    }
  }

  async stop(): Promise<void> {
    for (const line of this.#lines) line.terminate();
    await Promise.all(this.#connections.map((connection) => connection.close()));
    await Promise.all([this.#control, this.#telemetry, this.#streaming].map(closePlainServer));
  }

  // Pages

  #onControl(text: string): void {
    const message = parse<FromPage>(text);
    if (message?.type === 'initBridge') this.#connect(message.url);
    else if (message?.type === 'updateRobots') this.#getRobots();
    else if (message?.type === 'switchRobot' && typeof message.robotId === 'number')
      this.#switch(message.robotId);
  }

  #switch(robotId: number): void {
    this.#selected = robotId;
    for (const [id, { words }] of this.#robots) say(words, id === robotId ? 'start' : 'stop');
    broadcast(this.#control, JSON.stringify({ type: 'switchedRobot', robotId }));
  }

  /** @returns false if its handler breaks */
  #onTelemetry(text: string): boolean {
    const message = parse<FromPage>(text);
    const robot = this.#robots.get(this.#selected);
    if (message?.type !== 'command' || robot === undefined) return true;
    if (robot.control === null) return false;
    say(robot.control, Buffer.from(JSON.stringify(message.command)));
    return true;
  }

  #tellRobots(): void {
    const robots = [...this.#listed].map(([id, name]) => ({ id, name }));
    broadcast(
      this.#control,
      JSON.stringify({ type: 'updateRobots', robots: robots.length === 0 ? null : robots }),
    );
  }

  // Signaling

  #connect(url: string): void {
    const line = new WebSocket(url);
    line.on('error', () => undefined);
    line.on('open', () => {
      this.#lines.push(line);
      this.#getRobots();
    });
    line.on('message', (data) => {
      if (line !== this.#lines.at(-1)) return;
      this.#handling = this.#handling.then(() =>
        this.#onSignaling(JSON.parse(String(data)) as FromSignaling).catch((error: unknown) =>
          this.#die(error),
        ),
      );
    });
  }

  #getRobots(): void {
    this.#signal({ type: 'getRobots' });
  }

  #signal(message: object): void {
    const line = this.#lines.at(-1);
    if (line?.readyState === WebSocket.OPEN) line.send(JSON.stringify(message));
  }

  async #onSignaling(message: FromSignaling): Promise<void> {
    const { type, robotId } = message;
    if (type === 'robots') {
      for (const robot of message.robots) if (this.#isNew(robot.id)) await this.#add(robot);
      const ids = new Set(message.robots.map(({ id }) => id));
      for (const id of [...this.#listed.keys()]) if (!ids.has(id)) this.#forget(id);
      this.#tellRobots();
    } else if (type === 'register') {
      this.#listed.set(message.robot.id, message.robot.name);
      this.#tellRobots();
      await this.#add(message.robot);
    } else if (type === 'offer' && this.#listed.has(robotId)) {
      await this.#answer(robotId, message.sdpOffer);
      this.#tellRobots();
    } else if (type === 'candidate' && this.#listed.has(robotId)) {
      await this.#robots
        .get(robotId)
        ?.connection.addIceCandidate({ candidate: message.candidate, sdpMLineIndex: 0 })
        .catch(() => undefined);
      this.#tellRobots();
    } else if (type === 'deregistered' && this.#listed.has(robotId)) {
      this.#forget(robotId);
      this.#tellRobots();
    }
  }

  #isNew(id: number): boolean {
    const state = this.#robots.get(id)?.connection.connectionState;
    return !this.#listed.has(id) || state === undefined || state === 'failed' || state === 'closed';
  }

  #forget(id: number): void {
    this.#listed.delete(id);
    this.#robots.delete(id);
  }

  async #add({ id, name, sdpOffer }: ListedRobot): Promise<void> {
    this.#listed.set(id, name);
    const connection = createReferencePeerConnection();
    this.#connections.push(connection);
    const { bandwidth, words } = referenceChannels;
    const robot: Robot = {
      connection,
      bandwidth: connection.createDataChannel(bandwidth.label, { ordered: bandwidth.ordered }),
      words: connection.createDataChannel(words.label, {
        ordered: words.ordered,
        maxRetransmits: words.maxRetransmits,
      }),
      control: null,
      frames: new ReleasedFrames({
        onReport: (report) => say(robot.bandwidth, Buffer.from(report)),
        onFrame: (frame) => broadcast(this.#streaming, frame),
      }),
    };
    this.#robots.set(id, robot);
    connection.onDataChannel.subscribe((channel) => {
      robot.control = channel;
      channel.stateChanged.subscribe(() => this.#opened.push(true));
      this.#opened.push(true);
    });
    robot.words.stateChanged.subscribe(() => this.#opened.push(true));
    connection.onIceCandidate.subscribe((candidate) => {
      prepareSockets(connection);
      if (candidate !== undefined)
        this.#signal({ type: 'candidate', robotId: id, candidate: candidate.toJSON().candidate });
    });
    connection.connectionStateChange.subscribe((state) => {
      const [dtls] = connection.dtlsTransports;
      if (state !== 'connected' || dtls === undefined) return;
      tapRtp(dtls, (packet) => robot.frames.accept(packet, id === this.#selected, performance.now()));
    });
    if (sdpOffer !== null && sdpOffer !== '') await this.#answer(id, sdpOffer);
  }

  /** @throws {Error} for an offer that ends the program */
  async #answer(id: number, sdp: string): Promise<void> {
    const connection = this.#robots.get(id)?.connection;
    if (connection === undefined) return;
    await connection.setRemoteDescription({ type: 'offer', sdp });
    const answer = await connection.createAnswer();
    // Resolves only when every candidate is gathered; they follow one by one.
    connection.setLocalDescription(answer).catch(() => undefined);
    this.#signal({ type: 'answer', robotId: id, sdpAnswer: answer.sdp });
  }

  #die(error: unknown): void {
    this.death ??= String(error);
    void this.stop();
  }
}

function parse<T>(text: string): T | null {
  try {
    return JSON.parse(text) as T | null;
  } catch {
    return null;
  }
}

function say(channel: RTCDataChannel, data: string | Buffer): void {
  if (channel.readyState === 'open') channel.send(data);
}

function broadcast(server: WebSocketServer, data: string | Uint8Array): void {
  for (const socket of server.clients) if (socket.readyState === WebSocket.OPEN) socket.send(data);
}
