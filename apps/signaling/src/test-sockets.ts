/** For tests of the whole service on loopback: sockets whose messages can be awaited. */
import { WebSocket } from 'ws';
import type { SignalingOptions } from './options.ts';
import { type RunningSignaling, type SignalingRim, startSignaling } from './server.ts';
import type { Json } from './test-support.ts';

export class TestSocket {
  readonly socket: WebSocket;
  readonly closed: Promise<{ code: number; reason: string }>;
  readonly #inbox: Json[] = [];
  #waiting: (() => void)[] = [];
  #isClosed = false;

  private constructor(url: string, options: ConstructorParameters<typeof WebSocket>[2]) {
    this.socket = new WebSocket(url, { perMessageDeflate: false, ...options });
    this.socket.on('message', (data: Buffer, binary: boolean) => {
      if (binary) throw new Error('the service sent a binary message');
      this.#inbox.push(JSON.parse(data.toString('utf8')) as Json);
      this.#wake();
    });
    this.socket.on('error', () => {});
    this.closed = new Promise((resolve) => {
      this.socket.on('close', (code, reason) => {
        this.#isClosed = true;
        resolve({ code, reason: reason.toString('utf8') });
        this.#wake();
      });
    });
  }

  /** @throws {Error} `Unexpected server response: 403` and the like if the service refuses */
  static async open(
    url: string,
    options: ConstructorParameters<typeof WebSocket>[2] = {},
  ): Promise<TestSocket> {
    const made = new TestSocket(url, options);
    await new Promise<void>((resolve, reject) => {
      made.socket.once('open', resolve);
      made.socket.once('error', reject);
    });
    return made;
  }

  send(message: unknown): void {
    this.socket.send(JSON.stringify(message));
  }

  /** The next message, waiting if necessary; `null` once the socket is closed and all messages are read. */
  async next(): Promise<Json | null> {
    for (;;) {
      const message = this.#inbox.shift();
      if (message !== undefined) return message;
      if (this.#isClosed) return null;
      await new Promise<void>((resolve) => this.#waiting.push(resolve));
    }
  }

  /** The next message of this type; skips others. */
  async until(type: string): Promise<Json> {
    for (;;) {
      const message = await this.next();
      if (message === null) throw new Error(`closed before ${type}`);
      if (message.type === type) return message;
    }
  }

  #wake(): void {
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const wake of waiting) wake();
  }
}

/** A service on free ports, and clients for it. */
export class TestService {
  readonly service: RunningSignaling;
  readonly #sockets: TestSocket[] = [];
  readonly #scheme: string;

  private constructor(service: RunningSignaling, scheme: string) {
    this.service = service;
    this.#scheme = scheme;
  }

  static async start(options: Partial<SignalingOptions> = {}, rim: SignalingRim = {}): Promise<TestService> {
    const ports = { port: 0, referenceRobotPort: 0, referenceClientPort: 0 };
    const service = await startSignaling({ shutdownMs: 200, reference: true, ...ports, ...options }, rim);
    return new TestService(service, options.tlsCert === undefined ? 'ws' : 'wss');
  }

  url(path: string, port: 'signaling' | 'referenceRobot' | 'referenceClient' = 'signaling'): string {
    return `${this.#scheme}://127.0.0.1:${this.service.ports[port]}${path}`;
  }

  http(path: string): string {
    return this.url(path).replace(/^ws/, 'http');
  }

  async open(url: string, options: Parameters<typeof TestSocket.open>[1] = {}): Promise<TestSocket> {
    const socket = await TestSocket.open(url, options);
    this.#sockets.push(socket);
    return socket;
  }

  /** A welcomed robot. */
  async robot(id: string, more: Json = {}): Promise<TestSocket> {
    const socket = await this.open(this.url('/robot'));
    socket.send({ type: 'robot.hello', protocol: 1, id, name: `Robot ${id}`, key: `key-${id}`, ...more });
    await socket.until('robot.welcome');
    return socket;
  }

  /** A welcomed operator. */
  async operator(more: Json = {}): Promise<TestSocket> {
    const socket = await this.open(this.url('/operator'));
    socket.send({ type: 'operator.hello', protocol: 1, name: 'Ada', ...more });
    await socket.until('operator.welcome');
    return socket;
  }

  async referenceRobot(name = 'Diane'): Promise<TestSocket> {
    const socket = await this.open(this.url('/any/path', 'referenceRobot'));
    socket.send({ type: 'register', name, sdpOffer: 'v=0' });
    return socket;
  }

  referenceClient(): Promise<TestSocket> {
    return this.open(this.url('/', 'referenceClient'));
  }

  /** Opens a session, relays an offer and an answer, closes it. */
  async expectSession(robot: TestSocket, robotId: string, operator: TestSocket): Promise<void> {
    operator.send({ type: 'session.open', robotId });
    const { session } = await operator.until('session.opened');
    await robot.until('session.request');
    robot.send({ type: 'session.offer', session, sdp: 'v=0 offer' });
    await operator.until('session.offer');
    operator.send({ type: 'session.answer', session, sdp: 'v=0 answer' });
    await robot.until('session.answer');
    operator.send({ type: 'session.close', session });
    await robot.until('session.closed');
  }

  async stop(): Promise<void> {
    for (const { socket } of this.#sockets) socket.terminate();
    await this.service.close();
  }
}
