import type { RTCDtlsTransport } from 'werift';
import { CandidatePairState } from 'werift';
import type { Refusals } from '../refusal.ts';
import { isAuthenticRequest, stunKind } from '../stun/binding-request.ts';
import { KnownSources } from '../stun/known-sources.ts';
import { guardRelay } from './guard-relay.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

type Address = readonly [host: string, port: number];
type Receive = (datagram: Buffer, address: Address) => void;

/** An ICE socket, or a relay allocation: each has one of the two. */
interface ProtocolShape {
  datagramReceived?: Receive;
  handleStunMessage?: Receive;
  /** Of a relay allocation. */
  turn?: object;
}

interface ConnectionShape {
  userHistory: Record<string, string>;
  checkList: { protocol: unknown; state: CandidatePairState; remoteAddr: Address }[];
  ensureProtocol(protocol: ProtocolShape): void;
}

/**
 * Filters what arrives at the ICE sockets. It passes on connectivity checks authenticated with our password, answers to
 * our own checks (which werift verifies), and data from addresses that such checks have shown to be the peer's.
 *
 * @throws {WeriftShapeError}
 */
export function guardIce(transport: RTCDtlsTransport, refusals: Refusals): void {
  const connection = transport.iceTransport.connection as unknown as ConnectionShape;
  expectMethods(connection, 'the ICE connection', ['ensureProtocol']);
  if (typeof connection.userHistory !== 'object' || !Array.isArray(connection.checkList)) {
    throw new WeriftShapeError('no credentials or candidate pairs in the ICE connection');
  }
  const passwordOf = (fragment: string) =>
    Object.hasOwn(connection.userHistory, fragment) ? connection.userHistory[fragment] : undefined;
  const ensureProtocol = connection.ensureProtocol.bind(connection);
  connection.ensureProtocol = (protocol) => {
    const name = typeof protocol.datagramReceived === 'function' ? 'datagramReceived' : 'handleStunMessage';
    expectMethods(protocol, 'the ICE socket', [name]);
    if (name === 'handleStunMessage') guardRelay(protocol.turn ?? {});
    const receive = (protocol[name] as Receive).bind(protocol);
    const sources = new KnownSources();
    // An ICE lite peer answers checks and sends none.
    const hasAnswered = (host: string, port: number) =>
      connection.checkList.some(
        (pair) =>
          pair.protocol === protocol &&
          pair.state === CandidatePairState.SUCCEEDED &&
          pair.remoteAddr[0] === host &&
          pair.remoteAddr[1] === port,
      );
    protocol[name] = (datagram, address) => {
      const [host, port] = address;
      const kind = stunKind(datagram);
      if (kind === 'request') {
        if (!isAuthenticRequest(datagram, passwordOf)) {
          refusals.add('stun-unauthenticated');
          return;
        }
        sources.add(host, port);
      } else if (kind === null && !sources.has(host, port)) {
        if (!hasAnswered(host, port)) {
          refusals.add('unknown-source');
          return;
        }
        sources.add(host, port);
      }
      receive(datagram, address);
    };
    ensureProtocol(protocol);
  };
}
