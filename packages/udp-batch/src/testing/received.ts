/** A UDP socket that keeps what it receives. */
import { createSocket, type Socket } from 'node:dgram';
import { once } from 'node:events';

export class Received {
  readonly socket: Socket;
  readonly datagrams: Buffer[] = [];
  #changed = Promise.withResolvers<void>();

  private constructor(socket: Socket) {
    this.socket = socket;
    socket.on('message', (datagram) => {
      this.datagrams.push(datagram);
      this.#changed.resolve();
      this.#changed = Promise.withResolvers();
    });
  }

  /** Bound to a loopback address. */
  static async at(address: '127.0.0.1' | '::1'): Promise<Received> {
    const socket = createSocket(address === '::1' ? 'udp6' : 'udp4').bind(0, address);
    await once(socket, 'listening');
    return new Received(socket);
  }

  get port(): number {
    return this.socket.address().port;
  }

  /** Resolves once there are that many. Loopback loses none while the receiver's buffer has room. */
  async until(count: number): Promise<readonly Buffer[]> {
    while (this.datagrams.length < count) await this.#changed.promise;
    return this.datagrams;
  }
}
