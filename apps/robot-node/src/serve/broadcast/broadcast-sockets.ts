import { createSocket, type Socket } from 'node:dgram';
import { isIPv6 } from 'node:net';
import type { SendDatagram } from './broadcast-transport.ts';

/** Where the relay takes one stream. */
export interface StreamPorts {
  port: number;
  /** `null` if the relay takes no RTCP for it. */
  rtcpPort: number | null;
}

/** UDP to a relay: a socket for each stream, and one for all RTCP. */
export class BroadcastSockets {
  /** Datagrams that the system did not take, or that the relay's machine refused. */
  failures = 0;
  readonly #address: string;
  readonly #rtp: readonly Socket[];
  readonly #rtcp: Socket;
  readonly #ports: readonly StreamPorts[];
  #closed = false;

  /**
   * @param address of the relay, IPv4 or IPv6
   * @param ports by stream
   * @param onRtcp called with what comes from a stream's RTCP port
   */
  constructor(
    address: string,
    ports: readonly StreamPorts[],
    onRtcp: (stream: number, compound: Uint8Array) => void,
  ) {
    this.#address = address;
    this.#ports = ports;
    const open = (): Socket => {
      const socket = createSocket(isIPv6(address) ? 'udp6' : 'udp4');
      // For example ECONNREFUSED while the relay restarts.
      socket.on('error', () => this.failures++);
      return socket;
    };
    this.#rtp = ports.map(({ port }) => {
      const socket = open();
      socket.connect(port, address);
      return socket;
    });
    this.#rtcp = open();
    this.#rtcp.on('message', (compound, from) => {
      const stream =
        from.address === address ? ports.findIndex(({ rtcpPort }) => rtcpPort === from.port) : -1;
      if (stream >= 0) onRtcp(stream, compound);
    });
  }

  /** Sends one stream's packets. */
  sender(stream: number): SendDatagram {
    const socket = this.#rtp[stream] as Socket;
    let connected = false;
    socket.once('connect', () => {
      connected = true;
    });
    return (pieces) => {
      if (!connected || this.#closed) return;
      socket.send(pieces as Uint8Array[], (error) => {
        if (error !== null) this.failures++;
      });
    };
  }

  /** Shows the relay where a stream's RTCP is to be sent. */
  knock(stream: number, packet: Uint8Array): void {
    const rtcpPort = this.#ports[stream]?.rtcpPort ?? null;
    if (rtcpPort === null || this.#closed) return;
    this.#rtcp.send(packet, rtcpPort, this.#address, (error) => {
      if (error !== null) this.failures++;
    });
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    for (const socket of [...this.#rtp, this.#rtcp]) socket.close();
  }
}
