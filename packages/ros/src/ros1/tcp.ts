/**
 * TCP for the library’s connections. Ours end once and for all when they are closed, as its own would read the header of a
 * connection made anew as a message; and what a slow subscriber does not take is dropped instead of kept.
 */
import { createServer, type Server, type Socket } from 'node:net';
import type { TcpAddress, TcpServer, TcpServerEvents, TcpSocket, TcpSocketEvents } from '@foxglove/ros1';
import { EventEmitter } from 'eventemitter3';

/** Bytes that may wait for a slow subscriber, beside those in the kernel. */
const MOST_WAITING = 64 * 1024;
/** What has not gone out by then after the connection was closed is lost, ms. */
const LINGER_MS = 300;

export class RosTcpSocket extends EventEmitter<TcpSocketEvents> implements TcpSocket {
  readonly #socket: Socket;
  readonly #host: string;
  readonly #port: number;
  readonly #onDropped: () => void;
  #ended = false;

  constructor(host: string, port: number, socket: Socket, onDropped: () => void) {
    super();
    this.#host = host;
    this.#port = port;
    this.#socket = socket;
    this.#onDropped = onDropped;
    socket.setNoDelay(true);
    socket.on('connect', () => this.emit('connect'));
    socket.on('data', (chunk) => this.emit('data', chunk));
    socket.on('end', () => this.emit('end'));
    socket.on('error', (error) => this.emit('error', error));
    socket.on('close', () => {
      this.#ended = true;
      this.emit('close');
    });
  }

  async remoteAddress(): Promise<TcpAddress | undefined> {
    const family = this.#socket.remoteFamily;
    return { port: this.#port, address: this.#host, ...(family === undefined ? {} : { family }) };
  }

  async localAddress(): Promise<TcpAddress | undefined> {
    const { localPort: port, localAddress: address } = this.#socket;
    return port === undefined || address === undefined ? undefined : { port, address };
  }

  async fd(): Promise<number | undefined> {
    return undefined;
  }

  async connected(): Promise<boolean> {
    return !this.#ended && !this.#socket.connecting;
  }

  /** Once: the library calls it again after a loss, and who watches the graph makes a new connection then. */
  async connect(): Promise<void> {
    if (this.#ended) return;
    this.#socket.connect(this.#port, this.#host);
  }

  async close(): Promise<void> {
    this.#ended = true;
    this.#socket.destroySoon();
    setTimeout(() => this.#socket.destroy(), LINGER_MS).unref();
  }

  async write(data: Uint8Array): Promise<void> {
    if (this.#socket.writableLength > MOST_WAITING) this.#onDropped();
    else if (!this.#ended) this.#socket.write(data);
  }

  /** Always: velocities do not wait for company. */
  async setNoDelay(): Promise<void> {}
}

export class RosTcpServer extends EventEmitter<TcpServerEvents> implements TcpServer {
  readonly #server: Server;

  private constructor(server: Server, onDropped: () => void) {
    super();
    this.#server = server;
    server.on('connection', (socket) => {
      const { remoteAddress, remotePort } = socket;
      if (remoteAddress === undefined || remotePort === undefined) return;
      this.emit('connection', new RosTcpSocket(remoteAddress, remotePort, socket, onDropped));
    });
    server.on('error', (error) => this.emit('error', error));
  }

  /** @param host `undefined`: every interface */
  static async listen(host: string | undefined, onDropped: () => void): Promise<RosTcpServer> {
    const server = createServer();
    await new Promise<void>((resolve, reject) => {
      server.once('error', reject);
      server.listen(0, host, () => {
        server.off('error', reject);
        resolve();
      });
    });
    return new RosTcpServer(server, onDropped);
  }

  async address(): Promise<TcpAddress | undefined> {
    const address = this.#server.address();
    return address === null || typeof address === 'string' ? undefined : address;
  }

  close(): void {
    this.#server.close();
  }
}
