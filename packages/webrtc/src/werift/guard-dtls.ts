import { isDtls, type RTCDtlsTransport } from 'werift';
import { DtlsGate } from '../dtls/dtls-gate.ts';
import type { UnprovenPeerError } from '../dtls/peer-proof.ts';
import type { Refusals } from '../refusal.ts';
import { asDtlsSocket, WeriftDtlsEndpoint } from './dtls-endpoint.ts';
import { expectMethods } from './werift-shape.ts';

/** A peer sends one or two hellos before our own connectivity checks succeed. */
const MAX_EARLY_DATAGRAMS = 8;

/**
 * Puts a {@link DtlsGate} in front of a transport's DTLS socket as soon as the socket exists. Datagrams that arrive
 * earlier are kept and replayed to it: werift would lose them, and a peer repeats its hello only after a second.
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
  // werift creates its socket before its first await.
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
