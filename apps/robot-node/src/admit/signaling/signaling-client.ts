import {
  decodeJson,
  encodeJson,
  MAX_SIGNALING_BYTES,
  PROTOCOL_VERSION,
  ProtocolError,
  type RobotToService,
  robotToServiceCodec,
  type ServiceToRobot,
  serviceToRobotCodec,
  signalingEndpoint,
} from '@farpoint/protocol';
import type { Logger, Secret } from '@farpoint/service';
import { Reconnect } from '@farpoint/timing';
import { WebSocket } from 'ws';

/**
 * A half-open connection is given up after two of these, ms. Chosen: while somebody waits, a check finds it
 * in 2 s; this one is for robots that nobody asks for, and each of thousands costs the service a ping.
 */
const HEARTBEAT_MS = 10_000;
/**
 * A ping that checks a doubtful connection must be answered within this time, ms; otherwise the connection is
 * given up. Chosen: longer than TCP's first repetition of a lost packet, 1 s (RFC 6298, 2.1); the page waits
 * as long.
 */
const CHECK_TIMEOUT_MS = 2000;
/**
 * Shortest interval between such pings, ms. The service disconnects clients that ping without limit. Chosen:
 * the page asks for a restart once a second at most (resume-policy.ts).
 */
const CHECK_INTERVAL_MS = 500;

/** Pings one connection, at intervals and on demand, and terminates it if no answer comes. */
class Liveness {
  /** Why it terminated the connection; empty if it did not. */
  fault = '';
  readonly #socket: Pick<WebSocket, 'ping' | 'terminate'>;
  #alive = true;
  #heartbeat: NodeJS.Timeout | null = null;
  #checking: NodeJS.Timeout | null = null;
  #checkedMs = Number.NEGATIVE_INFINITY;

  constructor(socket: Pick<WebSocket, 'ping' | 'terminate'>) {
    this.#socket = socket;
  }

  /** Call this once the connection is open. */
  start(): void {
    this.#heartbeat = setInterval(() => {
      if (!this.#alive) {
        this.#giveUp();
        return;
      }
      this.#alive = false;
      this.#socket.ping();
    }, HEARTBEAT_MS);
  }

  /** Something came from the other side. */
  heard(): void {
    this.#alive = true;
    if (this.#checking !== null) clearTimeout(this.#checking);
    this.#checking = null;
  }

  /** Asks for a sign of life now, unless it did a moment ago. */
  check(): void {
    const nowMs = performance.now();
    if (this.#checking !== null || nowMs - this.#checkedMs < CHECK_INTERVAL_MS) return;
    this.#checkedMs = nowMs;
    this.#checking = setTimeout(() => this.#giveUp(), CHECK_TIMEOUT_MS);
    this.#socket.ping();
  }

  stop(): void {
    if (this.#heartbeat !== null) clearInterval(this.#heartbeat);
    if (this.#checking !== null) clearTimeout(this.#checking);
  }

  #giveUp(): void {
    this.fault = 'no answer to a ping';
    this.#socket.terminate();
  }
}

export interface SignalingOptions {
  /** `ws://` or `wss://` and host. The client appends `/robot`. */
  url: string;
  id: string;
  name: string;
  /** Proves after a reconnect that this is the same robot. */
  key: Secret;
  token: Secret | null;
  /** PEM of certificate authorities to trust instead of the system's. */
  ca: string | null;
}

/** The service refused a robot.hello or another message. */
export type SignalingRefusal = Extract<ServiceToRobot, { type: 'error' }>;

/**
 * With more unsent bytes than this, the service counts as gone. Chosen: 16 of its largest messages.
 */
const MAX_BACKLOG_BYTES = 16 * MAX_SIGNALING_BYTES;

/**
 * The robot's connection to the signaling service. It reconnects forever, and introduces the robot again each time.
 * Messages sent while the connection is down are dropped: a session that was being set up fails by its own timeout,
 * and an established one needs nothing.
 */
export class SignalingClient {
  onMessage: ((message: ServiceToRobot) => void) | null = null;
  /** Whether the service has answered robot.hello. */
  registered = false;
  /** How often it has done so. */
  registrations = 0;
  /** Failed or broken connections since the start. */
  disconnects = 0;
  /** Messages that could not be read. */
  malformed = 0;
  /** Messages not sent because the line was down. */
  unsent = 0;
  readonly #options: SignalingOptions;
  readonly #log: Logger;
  readonly #reconnect = new Reconnect(Math.random);
  #socket: WebSocket | null = null;
  #retry: NodeJS.Timeout | null = null;
  #closed = false;
  /** Whether the loss of the service has been logged. */
  #missed = false;
  #check: (() => void) | null = null;
  /** What has become of statuses on this connection. An older service does not know them. */
  #statuses: 'none' | 'sent' | 'refused' = 'none';

  constructor(options: SignalingOptions, log: Logger) {
    this.#options = options;
    this.#log = log;
  }

  start(): void {
    this.#connect();
  }

  /** Whether the service can be told the robot's status now. */
  get takesStatus(): boolean {
    return this.registered && this.#statuses !== 'refused';
  }

  /** @returns false if the connection is down */
  send(message: RobotToService): boolean {
    const socket = this.#socket;
    if (!this.registered || socket === null || socket.readyState !== WebSocket.OPEN) {
      this.unsent++;
      return false;
    }
    if (socket.bufferedAmount > MAX_BACKLOG_BYTES) {
      socket.terminate();
      return false;
    }
    if (message.type === 'robot.status') this.#statuses = 'sent';
    socket.send(encodeJson(robotToServiceCodec, message));
    return true;
  }

  /**
   * Checks that the service is alive, unless a check was sent a moment ago. A dead connection is given up within 2.5
   * s. May be called as often as the connection is in doubt.
   */
  check(): void {
    this.#check?.();
  }

  async close(): Promise<void> {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    const socket = this.#socket;
    if (socket === null) return;
    const gone = new Promise((resolve) => socket.once('close', resolve));
    socket.close(1001, 'robot is shutting down');
    const timer = setTimeout(() => socket.terminate(), 1000);
    await gone;
    clearTimeout(timer);
  }

  #connect(): void {
    const { url, ca } = this.#options;
    const socket = new WebSocket(signalingEndpoint(url, 'robot'), {
      handshakeTimeout: this.#reconnect.timeoutMs,
      maxPayload: MAX_SIGNALING_BYTES,
      perMessageDeflate: false,
      ...(ca === null ? {} : { ca }),
    });
    this.#socket = socket;
    const liveness = new Liveness(socket);
    let detail = '';
    socket.on('open', () => {
      this.#check = () => liveness.check();
      // The welcome may be lost if the network is.
      liveness.check();
      this.#sayHello(socket);
      liveness.start();
    });
    socket.on('pong', () => liveness.heard());
    socket.on('message', (data: Buffer, binary: boolean) => {
      liveness.heard();
      this.#receive(binary ? data : data.toString('utf8'));
    });
    socket.on('error', (error) => {
      detail = error.message;
    });
    socket.on('close', (code, reason) => {
      liveness.stop();
      this.#check = null;
      this.#socket = null;
      this.registered = false;
      if (this.#closed) return;
      this.#reconnectLater(code, liveness.fault || detail || reason.toString('utf8'));
    });
  }

  #sayHello(socket: WebSocket): void {
    const { id, name, key, token } = this.#options;
    const hello: RobotToService = {
      type: 'robot.hello',
      protocol: PROTOCOL_VERSION,
      id,
      name,
      key: key.reveal(),
      ...(token === null ? {} : { token: token.reveal() }),
    };
    socket.send(encodeJson(robotToServiceCodec, hello));
  }

  #reconnectLater(code: number, detail: string): void {
    this.disconnects++;
    const waitMs = this.#reconnect.nextMs();
    const facts = { url: this.#options.url, code, detail, retryMs: Math.round(waitMs) };
    // Warn once until the robot is registered again: it may have only the reference system's signaling.
    if (this.#missed) this.#log.debug(facts, 'still no connection to signaling');
    else this.#log.warn(facts, 'no connection to signaling; will keep trying silently');
    this.#missed = true;
    this.#retry = setTimeout(() => this.#connect(), waitMs);
  }

  #receive(data: string | Uint8Array): void {
    let message: ServiceToRobot;
    try {
      message = decodeJson(serviceToRobotCodec, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.malformed++;
      this.#log.warn({ err: error }, 'unreadable message from signaling');
      return;
    }
    if (message.type === 'robot.welcome') {
      this.registered = true;
      this.registrations++;
      this.#statuses = 'none';
      this.#missed = false;
      this.#reconnect.reset();
      this.#log.info({ url: this.#options.url, id: message.id }, 'registered with signaling');
    }
    if (message.type === 'error' && message.code === 'malformed' && this.#statuses === 'sent') {
      this.#statuses = 'refused';
      this.#log.info({ url: this.#options.url }, 'the signaling service is older: its list shows no status');
    }
    this.onMessage?.(message);
  }
}
