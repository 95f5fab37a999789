/** A WebSocket server for pages on this machine: bound to loopback unless told otherwise, Origin checked. */
import type { AddressInfo } from 'node:net';
import { WebSocket, WebSocketServer } from 'ws';

export interface LocalSocketServerOptions {
  host: string;
  port: number;
  /** Beside pages served from this machine. */
  allowedOrigins: readonly string[];
  maxMessageBytes: number;
}

export interface LocalSocketEvents {
  onOpen?: (socket: WebSocket) => void;
  onMessage?: (data: string | Uint8Array) => void;
}

const MAX_SOCKETS = 16;
const LOCAL_HOSTS = new Set(['localhost', '127.0.0.1', '[::1]']);

/** Browsers always name the page's origin; programs on this machine need not. */
export function originAllowed(origin: string | undefined, allowed: readonly string[]): boolean {
  if (origin === undefined || allowed.includes(origin)) return true;
  try {
    const { protocol, hostname } = new URL(origin);
    return (protocol === 'http:' || protocol === 'https:') && LOCAL_HOSTS.has(hostname);
  } catch {
    return false;
  }
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
      socket.on('message', (data: Buffer, binary: boolean) =>
        events.onMessage?.(binary ? data : data.toString('utf8')),
      );
      events.onOpen?.(socket);
    });
  }

  /** @throws {Error} where the address cannot be listened on */
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
      verifyClient: ({ origin }: { origin?: string }) => originAllowed(origin, allowedOrigins),
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
   * To every page that has read all but so many bytes of what was sent before.
   *
   * @param onDone called once, when no socket looks at the data any more
   * @returns how many pages those are
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
      if (socket.readyState !== WebSocket.OPEN) continue;
      if (socket.bufferedAmount > maxBacklogBytes) {
        this.unsent++;
        continue;
      }
      holders++;
      // Called once, be it with an error.
      socket.send(data, letGo);
      reached++;
    }
    letGo();
    return reached;
  }

  async close(): Promise<void> {
    const closed = new Promise<void>((resolve) => this.#server.close(() => resolve()));
    for (const socket of this.#server.clients) socket.terminate();
    await closed;
  }
}
