/** Completes werift's ICE, above all for restarts by the side that offers. */
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

/** Call before candidates are gathered: without a configured STUN server, werift would ask a public one. */
export function dropDefaultStun(dtls: RTCDtlsTransport): void {
  const connection = dtls.iceTransport.connection as unknown as Partial<ConnectionShape>;
  if (connection.options === undefined) throw new WeriftShapeError('no ICE options');
  if (connection.options.stunServer === undefined) connection.stunServer = undefined;
}

/**
 * Call between the new offer and its local description. Closes every socket and relay allocation of the old generation,
 * so that the next gathering opens new ones on the present addresses. werift would offer the old ones again: bound to
 * addresses that may be gone, without asking STUN anew, and with one more relay allocation each time.
 */
export function discardSockets(dtls: RTCDtlsTransport): void {
  const protocols = protocolsOf(dtls);
  for (const protocol of protocols.splice(0)) protocol.close?.().catch(() => undefined);
}

/**
 * Call after an answer, once there is a local candidate: starts connectivity checks. werift starts them only before its
 * first DTLS handshake. Later it would wait for the peer's checks, which a NAT in front of us may block.
 *
 * @returns false if there is no local candidate yet
 */
export function startChecks(dtls: RTCDtlsTransport): boolean {
  if (protocolsOf(dtls).length === 0) return false;
  // If all checks fail, the next restart tries again.
  dtls.iceTransport.start().catch(() => undefined);
  return true;
}

/**
 * Pairs local candidates that were found after the peer's. werift pairs them only when its checks start, so a relay,
 * which takes a moment to be allocated, would stay unused. Does nothing if there is nothing to pair.
 */
export function pairLateCandidates(dtls: RTCDtlsTransport): void {
  const connection = dtls.iceTransport.connection as unknown as Partial<ConnectionShape>;
  const { checkList } = connection;
  if (!Array.isArray(checkList) || typeof connection.pairLocalProtocol !== 'function') {
    throw new WeriftShapeError('no list of candidate pairs');
  }
  for (const protocol of protocolsOf(dtls)) connection.pairLocalProtocol(protocol);
  // Until then, the peer's password is unknown.
  if (connection.nominated !== undefined || !connection.remotePassword || checkList.length === 0) return;
  for (const pair of checkList) {
    if (pair.state === CandidatePairState.WAITING) pair.handle = connection.checkStart?.(pair);
  }
}
