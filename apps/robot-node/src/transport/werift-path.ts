/**
 * What we need of werift's insides to send RTP ourselves: keys, the selected candidate pair, decrypted RTCP. Everything
 * here is looked up at run time and checked, so that another werift version fails with a message and not with silence.
 */
import type { Buffer } from 'node:buffer';
import { Socket } from 'node:dgram';
import { WeriftShapeError } from '@farpoint/webrtc';
import type { RTCDtlsTransport } from 'werift';

const SRTP_AEAD_AES_128_GCM = 7;

export interface SrtpKeys {
  /** 16 bytes. */
  key: Uint8Array;
  /** 12 bytes or more; the first 12 count. */
  salt: Uint8Array;
}

/**
 * @returns the session keys for what we send, or `null` where the peer did not take AES-128-GCM
 * @throws {WeriftShapeError}
 */
export function outgoingSrtpKeys(dtls: RTCDtlsTransport): SrtpKeys | null {
  const context = dtls.srtp?.localContext;
  if (context === undefined) throw new WeriftShapeError('no SRTP context after DTLS connected');
  if (context.profile !== SRTP_AEAD_AES_128_GCM) return null;
  const { srtpSessionKey: key, srtpSessionSalt: salt } = context;
  if (key?.byteLength !== 16 || !(salt?.byteLength >= 12))
    throw new WeriftShapeError('unknown SRTP key layout');
  return { key, salt };
}

/** Hands every decrypted RTCP compound packet to `tap`, before werift parses it. */
export function tapRtcp(dtls: RTCDtlsTransport, tap: (compound: Uint8Array) => void): void {
  const { srtcp } = dtls;
  if (typeof srtcp?.decrypt !== 'function')
    throw new WeriftShapeError('no SRTCP context after DTLS connected');
  const decrypt = srtcp.decrypt;
  srtcp.decrypt = (data: Buffer) => {
    const compound = decrypt(data);
    tap(compound);
    return compound;
  };
}

/** A socket on which more than this waits, bytes, gets no more for now: the kernel's queue is full already. */
const MAX_SOCKET_BACKLOG = 524_288;

const guarded = new WeakSet<Socket>();
let socketErrors = 0;

/** werift leaves a socket's errors (an unreachable network, say) unheard, and Node ends the process for them. */
export function guardSocket(socket: unknown): void {
  if (!(socket instanceof Socket) || guarded.has(socket)) return;
  guarded.add(socket);
  socket.on('error', () => {
    socketErrors++;
  });
}

/** Errors of all ICE sockets so far. */
export function iceSocketErrors(): number {
  return socketErrors;
}

interface UdpPath {
  socket: Socket;
  address: string;
  port: number;
}

interface StunProtocolShape {
  type: string;
  transport: { type: string; closed: boolean; socket: Socket };
}

/** The peer as ICE sees it now: datagrams go straight to the socket where the path is plain UDP. */
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
   * Looks the selected pair up again; call before each burst.
   *
   * @returns false where nothing may be sent: no pair, the peer's consent (RFC 7675) has run out, a socket that is full
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
    this.#udp = { socket: transport.socket, address: pair.remoteAddr[0], port: pair.remoteAddr[1] };
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

  /** Sends the parts as one datagram. They must not be changed before the next turn of the event loop. */
  send(parts: readonly Buffer[]): void {
    const udp = this.#udp;
    if (udp !== null) {
      udp.socket.send(parts as Buffer[], udp.port, udp.address);
      return;
    }
    this.#dtls.iceTransport.connection.send(concat(parts)).catch(() => {
      this.failed++;
    });
  }
}

function concat(parts: readonly Buffer[]): Buffer {
  return globalThis.Buffer.concat(parts as Buffer[]);
}
