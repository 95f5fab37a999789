import { isDtls, type RTCDtlsTransport } from 'werift';
import { DtlsGate } from '../dtls/dtls-gate.ts';
import type { UnprovenPeerError } from '../dtls/peer-proof.ts';
import type { Refusals } from '../refusal.ts';
import { asDtlsSocket, WeriftDtlsEndpoint } from './dtls-endpoint.ts';
import { expectMethods } from './werift-shape.ts';

/** A peer greets once or twice before our own checks are through. */
const MAX_EARLY_DATAGRAMS = 8;

/**
 * Puts a {@link DtlsGate} before a transport's DTLS socket as soon as there is one. Datagrams that come before are kept
 * and played to it: werift would lose them, and a peer greets again only after a second.
 *
 * @throws {WeriftShapeError}
 */
export function guardDtls(
  transport: RTCDtlsTransport,
  refusals: Refusals,
  onUnproven: (error: UnprovenPeerError) => void,
): void {
  expectMethods(transport, 'the DTLS transport', ['start']);
  let gate: DtlsGate | null = null;
  const early: Buffer[] = [];
  const subscription = transport.iceTransport.connection.onData.subscribe((datagram: Buffer) => {
    if (gate !== null || !isDtls(datagram)) return;
    if (early.length < MAX_EARLY_DATAGRAMS) early.push(Buffer.from(datagram));
    else refusals.add('dtls-early');
  });
  const start = transport.start.bind(transport);
  // werift makes its socket before it first waits for anything.
  transport.start = () => {
    const started = start();
    if (transport.dtls === undefined) return started;
    const socket = asDtlsSocket(transport.dtls);
    const opened = new DtlsGate(new WeriftDtlsEndpoint(socket, transport, onUnproven), refusals);
    gate = opened;
    subscription.unSubscribe();
    socket.transport.socket.onData = (datagram) => opened.onDatagram(datagram);
    for (const datagram of early.splice(0)) opened.onDatagram(datagram);
    return started;
  };
}
