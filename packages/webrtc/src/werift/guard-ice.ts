import type { RTCDtlsTransport } from 'werift';
import { CandidatePairState } from 'werift';
import type { PeerBudget } from '../peer-budget.ts';
import type { Refusals } from '../refusal.ts';
import { isAuthenticRequest, stunKind } from '../stun/binding-request.ts';
import { KnownSources } from '../stun/known-sources.ts';
import { RecentChecks } from '../stun/recent-checks.ts';
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

interface PairShape {
  protocol: unknown;
  state: CandidatePairState;
  remoteAddr: Address;
  /** Of every check that ever came. */
  requestTransactionIds: Set<string>;
}

interface ConnectionShape {
  userHistory: Record<string, string>;
  checkList: PairShape[];
  remoteCandidates: readonly { host: string; port: number }[];
  /** That came before there were candidates. */
  earlyChecks: unknown[];
  ensureProtocol(protocol: ProtocolShape): void;
}

/** Checks and their answers are a few hundred bytes (RFC 8489 §6.1). */
const MAX_STUN_BYTES = 1280;
/** Addresses of a peer: 128 that it names, and those behind which a check of it comes. Each has pairs with all of ours. */
const MAX_REMOTE_CANDIDATES = 192;
const MAX_EARLY_CHECKS = 64;
/** werift counts repetitions with them, and nothing else. */
const MAX_TRANSACTION_IDS = 256;

/**
 * Filters what arrives at the ICE sockets. It passes on connectivity checks authenticated with our password, answers to
 * our own checks (which werift verifies), and data from addresses that such checks have shown to be the peer's.
 *
 * @throws {WeriftShapeError}
 */
export function guardIce(transport: RTCDtlsTransport, refusals: Refusals, budget: PeerBudget): void {
  const connection = transport.iceTransport.connection as unknown as ConnectionShape;
  expectMethods(connection, 'the ICE connection', ['ensureProtocol']);
  const { userHistory, checkList, remoteCandidates, earlyChecks } = connection;
  if (typeof userHistory !== 'object' || ![checkList, remoteCandidates, earlyChecks].every(Array.isArray)) {
    throw new WeriftShapeError('no credentials, candidates or pairs in the ICE connection');
  }
  const recent = new RecentChecks();
  const isOneTooMany = (host: string, port: number) =>
    connection.earlyChecks.length >= MAX_EARLY_CHECKS ||
    (connection.remoteCandidates.length >= MAX_REMOTE_CANDIDATES &&
      !connection.remoteCandidates.some((one) => one.host === host && one.port === port));
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
      if (kind !== null && datagram.length > MAX_STUN_BYTES) {
        refusals.add('stun-too-long');
        return;
      }
      if (kind === 'request') {
        if (!isAuthenticRequest(datagram, passwordOf)) {
          refusals.add('stun-unauthenticated');
          return;
        }
        const age = recent.note(datagram, host, port);
        if (age === 'moved') {
          refusals.add('stun-replayed');
          return;
        }
        if (!budget.take(age === 'new' ? 'stun' : 'stun-again', 1, performance.now())) {
          refusals.add('stun-rate-limited');
          return;
        }
        if (isOneTooMany(host, port)) {
          refusals.add('ice-too-many-sources');
          return;
        }
        sources.add(host, port);
        for (const { requestTransactionIds } of connection.checkList) {
          if (requestTransactionIds.size >= MAX_TRANSACTION_IDS) requestTransactionIds.clear();
        }
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
