/**
 * TCP sockets for the library’s connections. A closed socket stays closed, because the library's own would read the
 * header of a new connection as a message. Messages are assembled here, in reusable memory. What a slow subscriber does
 * not take is dropped, not kept.
 */
import { createServer, type Server, Socket, type SocketConstructorOpts } from 'node:net';
import type { TcpAddress, TcpServer, TcpServerEvents, TcpSocket, TcpSocketEvents } from '@foxglove/ros1';
import { EventEmitter } from 'eventemitter3';
import { MessageAssembly } from './message-assembly.ts';

/** Bytes that may wait for a slow subscriber, in addition to those in the kernel. */
const MOST_WAITING = 64 * 1024;
/** Size of one read. */
const READ_BYTES = 256 * 1024;
/** Data not sent by this time after the connection was closed is lost, ms. */
const LINGER_MS = 300;

export class RosTcpSocket extends EventEmitter<TcpSocketEvents> implements TcpSocket {
  readonly #socket: Socket;
  readonly #host: string;
  readonly #port: number;
  readonly #onDropped: () => void;
  #ended = false;
  /** Passes the library one complete message at a time. */
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

  /** To a publisher. @param onDropped called for each message it does not take */
  static to(host: string, port: number, onDropped: () => void): RosTcpSocket {
    let own: RosTcpSocket | null = null;
    // One reusable buffer for everything received: megabytes per message are too much for the garbage collector.
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

  /**
   * Connects only once: the library calls it again after a loss, but the graph's monitor then makes a new connection.
   */
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

  /** Always set: velocities must not wait for more data. */
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

  /** @param host `undefined` for every interface */
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
