import type { RTCDtlsTransport, RTCPeerConnection, RTCSctpTransport } from 'werift';
import type { UnprovenPeerError } from '../dtls/peer-proof.ts';
import { PeerBudget, SharedBudget } from '../peer-budget.ts';
import { type Refusal, Refusals } from '../refusal.ts';
import { guardDtls } from './guard-dtls.ts';
import { guardIce } from './guard-ice.ts';
import { guardMedia } from './guard-media.ts';
import { guardSctp } from './guard-sctp.ts';
import { useKeyObjects } from './key-objects.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

export interface ConnectionGuardEvents {
  /** Asked for each packet: whether the peer drives now, so that it has more to say than one that watches. */
  drives?(): boolean;
  /** False: the peer sends no media, and whatever looks like it is dropped unread. */
  takesRtp?: boolean;
  /** Called for each dropped packet. */
  onRefused?(reason: Refusal): void;
  /** The peer is not the one in the description; the connection fails right after this call. */
  onUnproven?(error: UnprovenPeerError): void;
  /** A listener of a data channel threw. */
  onFault?(error: unknown): void;
}

interface ConnectionShape {
  createDtlsTransport(options?: unknown): RTCDtlsTransport;
  createSctpTransport(): RTCSctpTransport;
}

/** Of all connections of this process, whose thread they share. */
const sharedBudget = new SharedBudget();

/**
 * Guards everything that a connection receives: ICE, DTLS, RTP, RTCP and SCTP. Call it before the connection has any transceiver
 * or channel.
 *
 * @returns counters of what is dropped from then on
 * @throws {WeriftShapeError}
 */
export function guardConnection(connection: RTCPeerConnection, events: ConnectionGuardEvents = {}): Refusals {
  if (connection.dtlsTransports.length > 0) throw new WeriftShapeError('guarded too late');
  const shape = connection as unknown as ConnectionShape;
  expectMethods(shape, 'the connection', ['createDtlsTransport', 'createSctpTransport']);
  const refusals = new Refusals(events.onRefused);
  const budget = new PeerBudget(() => events.drives?.() === true, sharedBudget);
  const createDtls = shape.createDtlsTransport.bind(connection);
  shape.createDtlsTransport = (options) => {
    const transport = createDtls(options);
    useKeyObjects(transport);
    guardIce(transport, refusals, budget);
    guardDtls(transport, refusals, (error) => events.onUnproven?.(error));
    guardMedia(transport, refusals, budget, events.takesRtp ?? true);
    return transport;
  };
  const createSctp = shape.createSctpTransport.bind(connection);
  shape.createSctpTransport = () => {
    const transport = createSctp();
    guardSctp(transport, refusals, budget, (error) => events.onFault?.(error));
    return transport;
  };
  return refusals;
}
