import { createSocket, type RemoteInfo, type Socket } from 'node:dgram';
import { isIP } from 'node:net';
import type { Endpoint } from './candidate.ts';
import type { Side } from './signaling-messages.ts';

/** The requested size; the kernel grants as much as it allows. */
const SOCKET_BUFFER_BYTES = 4 * 1024 * 1024;

/** A socket that stands in for one endpoint of a peer: packets sent to it are on their way to that endpoint. */
export class ForwardPort {
  readonly side: Side;
  readonly real: Endpoint;
  /** Resolves once {@link own} is known. */
  readonly ready: Promise<void>;
  /** When something was last sent or received; milliseconds. */
  usedMs: number;
  /** Sender of the latest packet: usually the next one has the same sender. */
  lastFrom: ForwardPort | null = null;
  sendErrors = 0;
  readonly #socket: Socket;
  #own: Endpoint | null = null;
  #closed = false;

  constructor(
    side: Side,
    real: Endpoint,
    bindAddress: string,
    nowMs: number,
    onPacket: (to: ForwardPort, data: Buffer, source: RemoteInfo) => void,
  ) {
    this.side = side;
    this.real = real;
    this.usedMs = nowMs;
    const family = isIP(real.address) === 6 ? 6 : 4;
    this.#socket = createSocket({
      type: family === 6 ? 'udp6' : 'udp4',
      recvBufferSize: SOCKET_BUFFER_BYTES,
      sendBufferSize: SOCKET_BUFFER_BYTES,
      // The host is always an address, so no look-up and no extra turn of the event loop per packet.
      lookup: (address, _options, callback) => callback(null, address, family),
    });
    this.#socket.on('message', (data, source) => onPacket(this, data, source));
    this.ready = new Promise((resolve, reject) => {
      this.#socket.once('error', reject);
      this.#socket.bind(0, bindAddress, () => {
        this.#socket.off('error', reject);
        // An unreachable peer is not an error of ours.
        this.#socket.on('error', () => {
          this.sendErrors++;
        });
        const { address, port } = this.#socket.address();
        this.#own = { address, port };
        resolve();
      });
    });
    // Callers that need `ready` await it; without a caller, a rejection must not end the process.
    this.ready.catch(() => this.close());
  }

  /** The endpoint to tell the other peer. `null` before {@link ready}. */
  get own(): Endpoint | null {
    return this.#own;
  }

  get closed(): boolean {
    return this.#closed;
  }

  /** Sends from this socket, as if the endpoint it stands in for had sent. */
  send(data: Buffer, to: Endpoint): void {
    if (this.#closed) return;
    this.#socket.send(data, to.port, to.address, this.#onSent);
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    this.#socket.close();
  }

  readonly #onSent = (error: Error | null): void => {
    if (error !== null) this.sendErrors++;
  };
}
