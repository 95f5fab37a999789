import { Buffer } from 'node:buffer';
import type { Socket } from 'node:dgram';
import type { DatagramBatch } from '@farpoint/udp-batch';
import type { RTCDtlsTransport } from 'werift';
import { batchOf } from './datagram-batches.ts';
import { guardSocket } from './ice-sockets.ts';

/** A socket with a longer backlog than this, bytes, gets no more for now: the kernel's queue is already full. */
const MAX_SOCKET_BACKLOG = 524_288;

interface UdpPath {
  batch: DatagramBatch;
  address: string;
  port: number;
}

interface StunProtocolShape {
  type: string;
  transport: { type: string; closed: boolean; socket: Socket };
}

/** The peer as ICE currently sees it. If the path is plain UDP, datagrams go straight to the socket, in batches. */
export class IcePath {
  readonly #dtls: RTCDtlsTransport;
  #udp: UdpPath | null = null;
  #seen = '';
  /** Datagrams that a relay or TCP path refused. */
  failed = 0;

  constructor(dtls: RTCDtlsTransport) {
    this.#dtls = dtls;
  }

  /**
   * Looks up the selected pair again; call before each burst.
   *
   * @returns false if nothing may be sent: no pair, the peer's consent (RFC 7675) has expired, or the socket is full
   */
  refresh(): boolean {
    this.#udp = null;
    const { connection } = this.#dtls.iceTransport;
    const pair = connection.nominated;
    if (pair === undefined || connection.state === 'closed' || connection.state === 'failed') return false;
    if ('consentFresh' in connection && connection.consentFresh === false) return false;
    const protocol = pair.protocol as unknown as Partial<StunProtocolShape>;
    const transport = protocol.transport;
    if (
      protocol.type !== 'stun' ||
      transport?.type !== 'udp' ||
      typeof transport.socket?.send !== 'function'
    ) {
      return true;
    }
    if (transport.closed || transport.socket.getSendQueueSize() > MAX_SOCKET_BACKLOG) return false;
    guardSocket(transport.socket);
    const [address, port] = pair.remoteAddr;
    this.#udp = { batch: batchOf(transport.socket), address, port };
    return true;
  }

  /** @returns whether the peer was heard on the selected pair since the last call: data, or a connectivity check */
  heardSinceLast(): boolean {
    const pair = this.#dtls.iceTransport.connection.nominated;
    if (pair === undefined) return false;
    const seen = `${pair.id} ${pair.packetsReceived} ${pair.requestsReceived} ${pair.responsesReceived}`;
    if (seen === this.#seen) return false;
    this.#seen = seen;
    return true;
  }

  /**
   * Sends the parts as one datagram, together with others of this turn of the event loop. They must not be changed
   * before the next turn.
   */
  send(parts: readonly Buffer[]): void {
    const udp = this.#udp;
    if (udp !== null) {
      udp.batch.send(parts, udp.port, udp.address);
      return;
    }
    this.#dtls.iceTransport.connection.send(concat(parts)).catch(() => {
      this.failed++;
    });
  }
}

function concat(parts: readonly Buffer[]): Buffer {
  return Buffer.concat(parts as Buffer[]);
}
