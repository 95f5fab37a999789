/**
 * TCP for the library’s connections. Ours end once and for all when they are closed, as its own would read the header of a
 * connection made anew as a message; messages are put together here, in memory that is used again; and what a slow subscriber
 * does not take is dropped instead of kept.
 */
import { createServer, type Server, Socket, type SocketConstructorOpts } from 'node:net';
import type { TcpAddress, TcpServer, TcpServerEvents, TcpSocket, TcpSocketEvents } from '@foxglove/ros1';
import { EventEmitter } from 'eventemitter3';
import { MessageAssembly } from './message-assembly.ts';

/** Bytes that may wait for a slow subscriber, beside those in the kernel. */
const MOST_WAITING = 64 * 1024;
/** Read at a time. */
const READ_BYTES = 256 * 1024;
/** What has not gone out by then after the connection was closed is lost, ms. */
const LINGER_MS = 300;

export class RosTcpSocket extends EventEmitter<TcpSocketEvents> implements TcpSocket {
  readonly #socket: Socket;
  readonly #host: string;
  readonly #port: number;
  readonly #onDropped: () => void;
  #ended = false;
  /** The library gets a message at a time, whole. */
  readonly #assembly = new MessageAssembly((framed) => this.emit('data', framed));

  private constructor(host: string, port: number, socket: Socket, onDropped: () => void) {
    super();
    this.#host = host;
    this.#port = port;
    this.#socket = socket;
    this.#onDropped = onDropped;
    socket.setNoDelay(true);
    socket.on('connect', () => this.emit('connect'));
    socket.on('data', (chunk) => this.#onBytes(chunk));
    socket.on('end', () => this.emit('end'));
    socket.on('error', (error) => this.emit('error', error));
    socket.on('close', () => {
      this.#ended = true;
      this.emit('close');
    });
  }

  /** To a publisher. @param onDropped called for what it does not take */
  static to(host: string, port: number, onDropped: () => void): RosTcpSocket {
    let own: RosTcpSocket | null = null;
    // One piece of memory for all that comes: megabytes a message are too much to leave to the collector.
    const buffer = new Uint8Array(READ_BYTES);
    const callback = (bytes: number) => {
      if (own !== null) own.#onBytes(buffer.subarray(0, bytes));
      return true;
    };
    const options: SocketConstructorOpts = { onread: { buffer, callback } };
    own = new RosTcpSocket(host, port, new Socket(options), onDropped);
    return own;
  }

  /** From a subscriber. */
  static from(socket: Socket, onDropped: () => void): RosTcpSocket | null {
    const { remoteAddress, remotePort } = socket;
    if (remoteAddress === undefined || remotePort === undefined) return null;
    return new RosTcpSocket(remoteAddress, remotePort, socket, onDropped);
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

  #onBytes(chunk: Uint8Array): void {
    if (this.#ended) return;
    try {
      this.#assembly.add(chunk);
    } catch (error) {
      this.emit('error', error instanceof Error ? error : new Error(String(error)));
      this.#socket.destroy();
    }
  }
}

export class RosTcpServer extends EventEmitter<TcpServerEvents> implements TcpServer {
  readonly #server: Server;

  private constructor(server: Server, onDropped: () => void) {
    super();
    this.#server = server;
    server.on('connection', (socket) => {
      const own = RosTcpSocket.from(socket, onDropped);
      if (own !== null) this.emit('connection', own);
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
