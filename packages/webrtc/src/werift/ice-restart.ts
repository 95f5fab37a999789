/** What werift leaves undone in ICE, above all where it is restarted by the side that offers. */
import { CandidatePairState, type RTCDtlsTransport } from 'werift';
import { WeriftShapeError } from './werift-shape.ts';

interface ProtocolShape {
  close?: () => Promise<unknown>;
}

interface ConnectionShape {
  stunServer: unknown;
  options: { stunServer?: unknown };
  nominated: unknown;
  remotePassword: string;
  checkList: { state: CandidatePairState; handle: unknown }[];
  pairLocalProtocol(protocol: ProtocolShape): void;
  checkStart(pair: unknown): unknown;
}

function protocolsOf(dtls: RTCDtlsTransport): ProtocolShape[] {
  const { protocols } = dtls.iceTransport.connection as unknown as { protocols?: ProtocolShape[] };
  if (!Array.isArray(protocols)) throw new WeriftShapeError('no list of ICE sockets');
  return protocols;
}

/** Before candidates are gathered: where no STUN server is configured werift would ask a public one. */
export function dropDefaultStun(dtls: RTCDtlsTransport): void {
  const connection = dtls.iceTransport.connection as unknown as Partial<ConnectionShape>;
  if (connection.options === undefined) throw new WeriftShapeError('no ICE options');
  if (connection.options.stunServer === undefined) connection.stunServer = undefined;
}

/**
 * Between the new offer and its local description: closes every socket and relay allocation of the old generation, so that
 * the next gathering opens new ones on the addresses of now. werift would offer the old ones again: bound to addresses
 * that may be gone, without asking STUN anew, and with one more relay allocation each time.
 */
export function discardSockets(dtls: RTCDtlsTransport): void {
  const protocols = protocolsOf(dtls);
  for (const protocol of protocols.splice(0)) protocol.close?.().catch(() => undefined);
}

/**
 * After an answer, once there is a local candidate: starts connectivity checks. werift starts them only before its first
 * DTLS handshake; afterwards it would wait for the peer's, which a NAT before us may not let in.
 *
 * @returns false where there is no local candidate yet
 */
export function startChecks(dtls: RTCDtlsTransport): boolean {
  if (protocolsOf(dtls).length === 0) return false;
  // Where all fail the next restart tries anew.
  dtls.iceTransport.start().catch(() => undefined);
  return true;
}

/**
 * Pairs local candidates that were found after the peer's: werift pairs them only at the start of its checks, so that a
 * relay, which takes a moment to be allocated, would stay unused. Does nothing where there is nothing to do.
 */
export function pairLateCandidates(dtls: RTCDtlsTransport): void {
  const connection = dtls.iceTransport.connection as unknown as Partial<ConnectionShape>;
  const { checkList } = connection;
  if (!Array.isArray(checkList) || typeof connection.pairLocalProtocol !== 'function') {
    throw new WeriftShapeError('no list of candidate pairs');
  }
  for (const protocol of protocolsOf(dtls)) connection.pairLocalProtocol(protocol);
  // Before that the peer's password is not known.
  if (connection.nominated !== undefined || !connection.remotePassword || checkList.length === 0) return;
  for (const pair of checkList) {
    if (pair.state === CandidatePairState.WAITING) pair.handle = connection.checkStart?.(pair);
  }
}
