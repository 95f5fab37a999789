import { CandidatePairState, type RTCDtlsTransport } from 'werift';
import type { PeerBudget } from '../peer-budget.ts';
import type { Refusal, Refusals } from '../refusal.ts';
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
  const gate = new DatagramGate(connection, budget);
  const ensureProtocol = connection.ensureProtocol.bind(connection);
  connection.ensureProtocol = (protocol) => {
    const name = typeof protocol.datagramReceived === 'function' ? 'datagramReceived' : 'handleStunMessage';
    expectMethods(protocol, 'the ICE socket', [name]);
    if (name === 'handleStunMessage') guardRelay(protocol.turn ?? {});
    const receive = (protocol[name] as Receive).bind(protocol);
    const socket = { protocol, sources: new KnownSources() };
    protocol[name] = (datagram, address) => {
      const refusal = gate.refusalOf(datagram, address, socket);
      if (refusal === null) receive(datagram, address);
      else refusals.add(refusal);
    };
    ensureProtocol(protocol);
  };
}

/** A socket, and the addresses that were shown to be the peer's there. */
interface GuardedSocket {
  readonly protocol: ProtocolShape;
  readonly sources: KnownSources;
}

/** Lets datagrams through to an ICE connection, or refuses them. */
class DatagramGate {
  readonly #connection: ConnectionShape;
  readonly #budget: PeerBudget;
  readonly #recent = new RecentChecks();
  readonly #passwordOf = (fragment: string): string | undefined => {
    const { userHistory } = this.#connection;
    return Object.hasOwn(userHistory, fragment) ? userHistory[fragment] : undefined;
  };

  constructor(connection: ConnectionShape, budget: PeerBudget) {
    this.#connection = connection;
    this.#budget = budget;
  }

  /** Why the datagram is dropped; `null`: it goes on, and what it shows of the peer's addresses is remembered. */
  refusalOf(datagram: Buffer, [host, port]: Address, { protocol, sources }: GuardedSocket): Refusal | null {
    const kind = stunKind(datagram);
    if (kind !== null && datagram.length > MAX_STUN_BYTES) return 'stun-too-long';
    if (kind === 'request') {
      const refusal = this.#refusalOfCheck(datagram, host, port);
      if (refusal !== null) return refusal;
      sources.add(host, port);
      this.#boundTransactionIds();
    } else if (kind === null && !sources.has(host, port)) {
      // An ICE lite peer answers checks and sends none.
      if (!this.#hasAnswered(protocol, host, port)) return 'unknown-source';
      sources.add(host, port);
    }
    return null;
  }

  #refusalOfCheck(datagram: Buffer, host: string, port: number): Refusal | null {
    if (!isAuthenticRequest(datagram, this.#passwordOf)) return 'stun-unauthenticated';
    const age = this.#recent.note(datagram, host, port);
    if (age === 'moved') return 'stun-replayed';
    if (!this.#budget.take(age === 'new' ? 'stun' : 'stun-again', 1, performance.now()))
      return 'stun-rate-limited';
    return this.#isOneTooMany(host, port) ? 'ice-too-many-sources' : null;
  }

  #isOneTooMany(host: string, port: number): boolean {
    const { earlyChecks, remoteCandidates } = this.#connection;
    return (
      earlyChecks.length >= MAX_EARLY_CHECKS ||
      (remoteCandidates.length >= MAX_REMOTE_CANDIDATES &&
        !remoteCandidates.some((one) => one.host === host && one.port === port))
    );
  }

  /** Whether one of our checks from this socket to this address has succeeded. */
  #hasAnswered(protocol: ProtocolShape, host: string, port: number): boolean {
    return this.#connection.checkList.some(
      (pair) =>
        pair.protocol === protocol &&
        pair.state === CandidatePairState.SUCCEEDED &&
        pair.remoteAddr[0] === host &&
        pair.remoteAddr[1] === port,
    );
  }

  #boundTransactionIds(): void {
    for (const { requestTransactionIds } of this.#connection.checkList) {
      if (requestTransactionIds.size >= MAX_TRANSACTION_IDS) requestTransactionIds.clear();
    }
  }
}
