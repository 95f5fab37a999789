/**
 * A WebSocket server for pages on this machine. It binds to loopback unless configured otherwise, and checks the
 * Origin.
 */
import type { AddressInfo } from 'node:net';
import { WebSocket, WebSocketServer } from 'ws';

export interface LocalSocketServerOptions {
  host: string;
  port: number;
  /** In addition to pages served from this machine. */
  allowedOrigins: readonly string[];
  maxMessageBytes: number;
}

/** Sends to the page on one socket, unless more than `maxBacklogBytes` of earlier data are unread. */
export type Send = (data: string, maxBacklogBytes: number) => void;

export interface LocalSocketEvents {
  onOpen?: (send: Send) => void;
  onMessage?: (data: string | Uint8Array, send: Send) => void;
  /** A page was refused because of its origin. */
  onRefused?: (origin: string) => void;
}

/** Chosen: five pages, with three sockets each. */
const MAX_SOCKETS = 16;
/** Characters of a refused origin that are shown. Chosen: it fits a line of the log. */
const MAX_SHOWN_ORIGIN = 200;
const LOCAL_HOSTS = new Set(['localhost', '127.0.0.1', '[::1]']);

/** Browsers always send the page's origin; programs on this machine need not. */
function originAllowed(origin: string | undefined, allowed: readonly string[]): boolean {
  if (origin === undefined || allowed.includes(origin)) return true;
  try {
    const { protocol, hostname } = new URL(origin);
    return (protocol === 'http:' || protocol === 'https:') && LOCAL_HOSTS.has(hostname);
  } catch {
    return false;
  }
}

/** Says how to allow the page, for the log and the body of the refusal. */
function originRefusal(origin: string): string {
  return `pages of ${origin} may not connect: start the bridge with --allowed-origins ${origin} to allow them\n`;
}

export class LocalSocketServer {
  /** Messages not sent because a page reads too slowly. */
  unsent = 0;
  readonly #server: WebSocketServer;

  private constructor(server: WebSocketServer, events: LocalSocketEvents) {
    this.#server = server;
    server.on('connection', (socket) => {
      socket.on('error', () => socket.terminate());
      if (server.clients.size > MAX_SOCKETS) {
        socket.close(1013, 'too many sockets');
        return;
      }
      const send: Send = (data, maxBacklogBytes) => this.#send(socket, data, maxBacklogBytes);
      socket.on('message', (data: Buffer, binary: boolean) =>
        events.onMessage?.(binary ? data : data.toString('utf8'), send),
      );
      events.onOpen?.(send);
    });
  }

  /** @throws {Error} if the address cannot be opened */
  static async open(
    options: LocalSocketServerOptions,
    events: LocalSocketEvents,
  ): Promise<LocalSocketServer> {
    const { host, port, allowedOrigins, maxMessageBytes } = options;
    const server = new WebSocketServer({
      host,
      port,
      maxPayload: maxMessageBytes,
      perMessageDeflate: false,
      verifyClient: ({ origin }: { origin?: string }, done) => {
        if (originAllowed(origin, allowedOrigins)) return done(true);
        const shown = (origin ?? '').slice(0, MAX_SHOWN_ORIGIN);
        events.onRefused?.(shown);
        done(false, 401, originRefusal(shown), { 'Content-Type': 'text/plain; charset=utf-8' });
      },
    });
    await new Promise<void>((resolve, reject) => {
      server.once('listening', resolve);
      server.once('error', reject);
    });
    return new LocalSocketServer(server, events);
  }

  get port(): number {
    return (this.#server.address() as AddressInfo).port;
  }

  get sockets(): number {
    return this.#server.clients.size;
  }

  /**
   * Sends to every page that has no more than `maxBacklogBytes` of unread data.
   *
   * @param onDone called once, when no socket uses the data any longer
   * @returns the number of these pages
   */
  broadcast(
    data: string | Uint8Array,
    maxBacklogBytes: number,
    onDone: () => void = () => undefined,
  ): number {
    let reached = 0;
    let holders = 1;
    const letGo = () => {
      if (--holders === 0) onDone();
    };
    for (const socket of this.#server.clients) {
      holders++;
      if (this.#send(socket, data, maxBacklogBytes, letGo)) reached++;
      else holders--;
    }
    letGo();
    return reached;
  }

  /** @param onDone called once when the data was sent or the attempt failed */
  #send(
    socket: WebSocket,
    data: string | Uint8Array,
    maxBacklogBytes: number,
    onDone: () => void = () => undefined,
  ): boolean {
    if (socket.readyState !== WebSocket.OPEN) return false;
    if (socket.bufferedAmount > maxBacklogBytes) {
      this.unsent++;
      return false;
    }
    socket.send(data, onDone);
    return true;
  }

  async close(): Promise<void> {
    const closed = new Promise<void>((resolve) => this.#server.close(() => resolve()));
    for (const socket of this.#server.clients) socket.terminate();
    await closed;
  }
}
