import { TokenBucket } from '@farpoint/timing';
import type { RawData, WebSocket } from 'ws';
import type { Pulse } from './heartbeat.ts';
import type { Connection, Peer } from './peer.ts';

export interface SocketPeerOptions {
  readonly id: number;
  readonly address: string;
  readonly maxBacklogBytes: number;
  /** Called when the peer is disconnected because it does not read or does not answer pings. */
  readonly onDropped: (reason: 'slow-consumer' | 'no-pong') => void;
}

const NO_DATA = Buffer.alloc(0);

/** One WebSocket as a {@link Peer}. */
export class SocketPeer implements Peer, Pulse {
  readonly id: number;
  readonly address: string;
  alive = true;
  readonly #socket: WebSocket;
  readonly #options: SocketPeerOptions;

  constructor(socket: WebSocket, options: SocketPeerOptions) {
    this.id = options.id;
    this.address = options.address;
    this.#socket = socket;
    this.#options = options;
  }

  get backlog(): number {
    return this.#socket.bufferedAmount;
  }

  send(message: string | Uint8Array): void {
    const socket = this.#socket;
    if (socket.readyState !== socket.OPEN) return;
    const backlog = socket.bufferedAmount;
    // A single message may exceed the limit if nothing is queued before it.
    if (backlog > 0 && backlog + message.length > this.#options.maxBacklogBytes) {
      this.#drop('slow-consumer');
      return;
    }
    socket.send(message, { binary: false });
  }

  close(code: number, reason: string): void {
    // ws itself cuts the connection if the peer does not answer the close (closeTimeout).
    this.#socket.close(code, reason);
  }

  terminate(): void {
    this.#socket.terminate();
  }

  ping(): void {
    if (this.#socket.readyState === this.#socket.OPEN) this.#socket.ping(NO_DATA);
  }

  dead(): void {
    this.#drop('no-pong');
  }

  /** Passes the socket's messages and its end to the hub. */
  attach(connection: Connection, onClosed: () => void): void {
    const socket = this.#socket;
    const pings = new TokenBucket({ perSecond: 10, burst: 50 });
    socket.on('message', (data: RawData, binary: boolean) => {
      this.alive = true;
      // A Buffer: ws's default binaryType is nodebuffer, and ws has checked that text is UTF-8.
      const bytes = data as Buffer;
      connection.receive(binary ? bytes : bytes.toString('utf8'));
    });
    socket.on('pong', () => {
      this.alive = true;
    });
    // Answered here rather than by ws, so that a flood of pings whose answers are not read cannot fill the memory.
    socket.on('ping', (data: Buffer) => {
      this.alive = true;
      if (!pings.take(performance.now()) || this.backlog > this.#options.maxBacklogBytes) socket.terminate();
      else if (socket.readyState === socket.OPEN) socket.pong(data);
    });
    // A violation of the WebSocket protocol or a message that is too long: ws closes with the right code, so there is
    // nothing to do.
    socket.on('error', () => {});
    socket.on('close', () => {
      connection.closed();
      onClosed();
    });
  }

  #drop(reason: 'slow-consumer' | 'no-pong'): void {
    if (this.#socket.readyState === this.#socket.CLOSED) return;
    this.#options.onDropped(reason);
    this.#socket.terminate();
  }
}
