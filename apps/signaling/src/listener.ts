import {
  createServer,
  type IncomingMessage,
  type RequestListener,
  type Server,
  STATUS_CODES,
} from 'node:http';
import { createServer as createTlsServer, type Server as TlsServer } from 'node:https';
import type { AddressInfo } from 'node:net';
import type { Duplex } from 'node:stream';
import { type ServerOptions, type WebSocket, WebSocketServer } from 'ws';
import { limitSocketsPerAddress } from './address-sockets.ts';

export interface TlsFiles {
  readonly cert: string;
  readonly key: string;
}

/** What to do with a request for a WebSocket. */
export type UpgradeDecision =
  | { readonly accept: (socket: WebSocket) => void }
  | { readonly status: number; readonly reason: string };

export interface ListenerOptions {
  readonly host: string;
  readonly port: number;
  readonly tls: TlsFiles | null;
  /** Longer messages close the connection (1009). */
  readonly maxPayload: number;
  readonly maxSockets: number;
  /** Of TCP connections. */
  readonly maxSocketsPerAddress: number;
  /** Whether an address is a proxy's, from which all of them come. */
  readonly isProxy: (address: string) => boolean;
  /** A connection was closed because its address has too many. */
  readonly onSocketRefused: (address: string) => void;
  readonly closeTimeoutMs: number;
  readonly http: RequestListener;
  readonly upgrade: (request: IncomingMessage) => UpgradeDecision;
}

/** One port with HTTP(S) and WebSockets. */
export class Listener {
  readonly port: number;
  readonly #server: Server | TlsServer;

  private constructor(server: Server | TlsServer) {
    this.#server = server;
    this.port = (server.address() as AddressInfo).port;
  }

  /** @throws {Error} if the address cannot be opened (EADDRINUSE, EACCES …) or the certificate is invalid */
  static async open(options: ListenerOptions): Promise<Listener> {
    const timeouts = {
      headersTimeout: 10_000,
      requestTimeout: 20_000,
      keepAliveTimeout: 5000,
      connectionsCheckingInterval: 2000,
    };
    const server =
      options.tls === null
        ? createServer(timeouts, options.http)
        : createTlsServer({ ...timeouts, ...options.tls }, options.http);
    server.maxConnections = options.maxSockets;
    limitSocketsPerAddress(server, options.maxSocketsPerAddress, options.isProxy, options.onSocketRefused);
    // The types of ws lack `closeTimeout`.
    const webSocketOptions: ServerOptions & { closeTimeout: number } = {
      noServer: true,
      clientTracking: false,
      // Compression would cost hundreds of kilobytes per connection, for messages of a few.
      perMessageDeflate: false,
      maxPayload: options.maxPayload,
      maxFragments: 1024,
      maxBufferedChunks: 4096,
      autoPong: false,
      closeTimeout: options.closeTimeoutMs,
    };
    const webSockets = new WebSocketServer(webSocketOptions);
    server.on('upgrade', (request, socket, head) => {
      socket.on('error', () => socket.destroy());
      const decision = options.upgrade(request);
      if ('status' in decision) refuse(socket, decision.status, decision.reason);
      // ws itself answers an invalid WebSocket handshake with 400.
      else webSockets.handleUpgrade(request, socket, head, decision.accept);
    });
    server.on('clientError', (_error, socket) => {
      if (socket.writable) refuse(socket, 400, 'not HTTP');
      else socket.destroy();
    });
    await new Promise<void>((resolve, reject) => {
      server.once('error', reject);
      server.listen({ port: options.port, host: options.host, backlog: 4096 }, () => {
        server.off('error', reject);
        resolve();
      });
    });
    return new Listener(server);
  }

  /** Sets the certificate for new connections; existing ones keep theirs. */
  setTls(tls: TlsFiles): void {
    if ('setSecureContext' in this.#server) this.#server.setSecureContext(tls);
  }

  /** Stops accepting connections; open WebSockets stay. */
  async close(): Promise<void> {
    const closed = new Promise<void>((resolve) => this.#server.close(() => resolve()));
    // Plain HTTP connections only: the server no longer owns upgraded ones.
    this.#server.closeAllConnections();
    await closed;
  }
}

function refuse(socket: Duplex, status: number, reason: string): void {
  const body = `${reason}\n`;
  socket.end(
    `HTTP/1.1 ${status} ${STATUS_CODES[status]}\r\nConnection: close\r\nContent-Type: text/plain; charset=utf-8\r\n` +
      `Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`,
    () => socket.destroy(),
  );
}
