/**
 * Access to what we need of a connected werift DTLS transport to send and receive RTP ourselves: its keys and the
 * packets it decrypts.
 */
import { Buffer } from 'node:buffer';
import type { RTCDtlsTransport, RtcpPacket } from 'werift';
import { WeriftShapeError } from './werift-shape.ts';

/** Transports whose RTCP is read by us. */
const tapped = new WeakSet<RTCDtlsTransport>();

export const NO_RTCP = Buffer.alloc(0);
/** What werift parses instead of a packet: an RTP header of a stream that it does not know. */
export const NO_RTP = Buffer.from([0x80, 0x7f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);

export interface SrtpKeys {
  /** SRTP protection profile (RFC 5764 §4.1.2). */
  profile: number;
  /** Session key. */
  key: Uint8Array;
  /** Session salt; the first 12 bytes count. */
  salt: Uint8Array;
}

type Deciphering = 'srtp' | 'srtcp';

/** @throws {WeriftShapeError} if werift's internals differ from what is expected, and before DTLS has connected */
export function srtpKeys(dtls: RTCDtlsTransport, direction: 'incoming' | 'outgoing'): SrtpKeys {
  const context = direction === 'incoming' ? dtls.srtp?.remoteContext : dtls.srtp?.localContext;
  if (context === undefined) throw new WeriftShapeError('no SRTP context after DTLS connected');
  const { profile, srtpSessionKey: key, srtpSessionSalt: salt } = context;
  if (!(key instanceof Uint8Array) || !(salt instanceof Uint8Array)) {
    throw new WeriftShapeError('unknown SRTP key layout');
  }
  return { profile, key, salt };
}

/**
 * Passes every decrypted compound RTCP packet to `tap`, and none to werift, which sends nothing that they could be about.
 *
 * @throws {WeriftShapeError}
 */
export function tapRtcp(dtls: RTCDtlsTransport, tap: (compound: Uint8Array) => void): void {
  intercept(dtls, 'srtcp', (data, decipher) => {
    tap(decipher(data));
    return NO_RTCP;
  });
  tapped.add(dtls);
}

export function isRtcpTapped(dtls: RTCDtlsTransport): boolean {
  return tapped.has(dtls);
}

/** Encrypts and sends a compound RTCP packet, if the connection still takes it. */
export function sendRtcp(dtls: RTCDtlsTransport, compound: Uint8Array): void {
  const bytes = Buffer.from(compound.buffer, compound.byteOffset, compound.byteLength);
  // werift asks nothing else of a packet.
  const packet = { serialize: () => bytes } as unknown as RtcpPacket;
  dtls.sendRtcp([packet]).catch(() => undefined);
}

/**
 * Passes every decrypted RTP packet, including its header, to `tap` before werift parses it.
 *
 * @throws {WeriftShapeError}
 */
export function tapRtp(dtls: RTCDtlsTransport, tap: (packet: Buffer) => void): void {
  intercept(dtls, 'srtp', (data, decipher) => {
    const packet = decipher(data);
    tap(packet);
    return packet;
  });
}

/**
 * Passes every RTP packet, still encrypted, to `take`, and none to werift.
 *
 * @param take also gets werift's own decryption, for what it cannot decrypt itself; that throws if a packet is not
 * authentic
 * @throws {WeriftShapeError}
 */
export function takeRtp(
  dtls: RTCDtlsTransport,
  take: (sealed: Buffer, decipher: (sealed: Buffer) => Buffer) => void,
): void {
  intercept(dtls, 'srtp', (data, decipher) => {
    take(data, decipher);
    return NO_RTP;
  });
}

function intercept(
  dtls: RTCDtlsTransport,
  which: Deciphering,
  by: (data: Buffer, decipher: (data: Buffer) => Buffer) => Buffer,
): void {
  const session = dtls[which];
  if (typeof session?.decrypt !== 'function') {
    throw new WeriftShapeError(`no ${which.toUpperCase()} context after DTLS connected`);
  }
  const decipher = session.decrypt;
  session.decrypt = (data: Buffer) => by(data, decipher);
}
