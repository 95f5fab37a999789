/** The sockets of a {@link LiveServer}: who may connect, and how much a connection may cost. */
import { createServer, type IncomingMessage, type Server, STATUS_CODES } from 'node:http';
import type { AddressInfo } from 'node:net';
import type { Duplex } from 'node:stream';
import { type RawData, WebSocket, WebSocketServer } from 'ws';
import type { LiveSocket } from './live-client.ts';
import type { LiveServer } from './live-server.ts';
import { isAllowedOrigin } from './origin.ts';
import { SUBPROTOCOLS } from './server-message.ts';

export interface LiveListenerOptions {
  host: string;
  /** 0 for any free one. */
  port: number;
  /** Origins of web pages that may connect, in addition to Foxglove's own and pages of this machine; `*` for all. */
  allowedOrigins: readonly string[];
  /** Names of this machine, by which its own pages may connect. */
  ownNames: readonly string[];
  /** Viewers at the same time. */
  mostClients: number;
}

/** Why a connection was refused. */
export type ConnectionRefusal =
  | 'origin' // a web page that is not allowed to connect
  | 'protocol' // it does not offer the protocol
  | 'too-many'; // as many viewers as there may be are connected

interface Refusal {
  why: ConnectionRefusal;
  code: number;
  sentence: string;
}

/** A viewer's messages are short; longer ones close the connection (1009). */
const MOST_MESSAGE_BYTES = 64 * 1024;
/** Below this size, head and bytes are copied into one frame: cheaper than two. */
const COPY_BELOW_BYTES = 16 * 1024;
/** A viewer that has not answered for this long is gone, ms. */
const PING_MS = 10_000;
/** TCP connections, also of those that never become viewers. */
const SPARE_CONNECTIONS = 16;

export class LiveListener {
  readonly refused: Record<ConnectionRefusal, number> = { origin: 0, protocol: 0, 'too-many': 0 };
  readonly #http: Server;
  readonly #sockets: WebSocketServer;
  readonly #pinging: NodeJS.Timeout;

  private constructor(http: Server, live: LiveServer, options: LiveListenerOptions) {
    this.#http = http;
    http.maxConnections = options.mostClients + SPARE_CONNECTIONS;
    this.#sockets = new WebSocketServer({
      noServer: true,
      maxPayload: MOST_MESSAGE_BYTES,
      // It would cost more time than it saves: clouds and videos do not become smaller.
      perMessageDeflate: false,
      handleProtocols: (offered) => SUBPROTOCOLS.find((each) => offered.has(each)) ?? false,
    });
    http.on('upgrade', (request, socket, head) => {
      socket.on('error', () => socket.destroy());
      const refusal = this.#refusalOf(request, options);
      if (refusal === null) {
        this.#sockets.handleUpgrade(request, socket, head, (client) => connect(client, live));
        return;
      }
      this.refused[refusal.why]++;
      refuse(socket, refusal);
    });
    this.#pinging = setInterval(() => this.#ping(), PING_MS);
    this.#pinging.unref();
  }

  /** @throws {Error} if the address cannot be opened (EADDRINUSE, EACCES …) */
  static async open(options: LiveListenerOptions, live: LiveServer): Promise<LiveListener> {
    const http = createServer({ headersTimeout: 10_000, requestTimeout: 10_000, keepAliveTimeout: 1000 });
    http.on('request', (_request, response) => {
      response.writeHead(426, { 'Content-Type': 'text/plain; charset=utf-8', Connection: 'close' });
      response.end('this is a Foxglove WebSocket server: open it in Foxglove or Lichtblick\n');
    });
    const listener = new LiveListener(http, live, options);
    await new Promise<void>((resolve, reject) => {
      http.once('error', reject);
      http.listen({ host: options.host, port: options.port }, () => {
        http.off('error', reject);
        // What fails later concerns one connection, such as one beyond the limit of open files.
        http.on('error', () => undefined);
        resolve();
      });
    });
    return listener;
  }

  get port(): number {
    return (this.#http.address() as AddressInfo).port;
  }

  async close(): Promise<void> {
    clearInterval(this.#pinging);
    const closed = new Promise<void>((resolve) => this.#http.close(() => resolve()));
    for (const socket of this.#sockets.clients) socket.terminate();
    this.#http.closeAllConnections();
    this.#sockets.close();
    await closed;
  }

  #refusalOf({ headers }: IncomingMessage, { mostClients, ...rules }: LiveListenerOptions): Refusal | null {
    if (!isAllowedOrigin(headers.origin, headers.host, rules)) {
      const sentence =
        'pages of this origin may not connect, or not by this name: see --foxglove-origins and --admin-names\n';
      return { why: 'origin', code: 403, sentence };
    }
    const offered = (headers['sec-websocket-protocol'] ?? '').split(',').map((name) => name.trim());
    if (!offered.some((name) => SUBPROTOCOLS.includes(name)))
      return { why: 'protocol', code: 400, sentence: `offer one of ${SUBPROTOCOLS.join(', ')}\n` };
    if (this.#sockets.clients.size >= mostClients)
      return { why: 'too-many', code: 503, sentence: 'too many viewers\n' };
    return null;
  }

  /** Ends connections whose other side is gone without a word. */
  #ping(): void {
    for (const socket of this.#sockets.clients) {
      if (unanswered.has(socket)) socket.terminate();
      else {
        unanswered.add(socket);
        socket.ping();
      }
    }
  }
}

/** Sockets that were pinged and have not been heard since. */
const unanswered = new WeakSet<WebSocket>();

function connect(socket: WebSocket, live: LiveServer): void {
  const client = live.accept(liveSocket(socket));
  socket.on('pong', () => unanswered.delete(socket));
  socket.on('error', () => socket.terminate());
  socket.on('close', () => live.remove(client));
  socket.on('message', (data: RawData, binary) => {
    unanswered.delete(socket);
    const bytes = data as Buffer;
    client.receive(binary ? bytes : bytes.toString('utf8'), performance.now());
  });
}

function refuse(socket: Duplex, { code, sentence }: Refusal): void {
  socket.end(
    `HTTP/1.1 ${code} ${STATUS_CODES[code]}\r\nConnection: close\r\nContent-Type: text/plain; charset=utf-8\r\n` +
      `Content-Length: ${Buffer.byteLength(sentence)}\r\n\r\n${sentence}`,
    () => socket.destroy(),
  );
}

function liveSocket(socket: WebSocket): LiveSocket {
  return {
    sendText: (text) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(text, () => undefined);
    },
    send: ([head, bytes], done) => {
      if (socket.readyState !== WebSocket.OPEN || head === undefined || bytes === undefined) return done();
      if (bytes.length < COPY_BELOW_BYTES) {
        socket.send(Buffer.concat([head, bytes]), done);
        return;
      }
      // One message of two fragments: a cloud is sent to several viewers without copying it for each.
      socket.send(head, { binary: true, fin: false });
      socket.send(bytes, { binary: true, fin: true }, done);
    },
    close: (code, reason) => socket.close(code, reason),
  };
}
