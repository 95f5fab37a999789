import { shortHash } from '@farpoint/audit';
import type { AdmissionRequest } from '@farpoint/grants';
import {
  type EndSession,
  type FaultReason,
  GRANT_ENDS_SOON_S,
  MAX_REVOCATIONS_LENGTH,
  type RobotSessionMessage,
} from '@farpoint/protocol';
import { WatchedText } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import type { ReasonCounts } from '../../ground/robot-counters.ts';
import type { OperatorPeer } from '../../send/transport/operator-peer.ts';
import { type Access, noAccess } from './access.ts';
import type { GrantFiles } from './grant-files.ts';
import { GrantGate, type GrantGateOptions } from './grant-gate.ts';
import type { GrantKeysFile } from './grant-keys-file.ts';
import { OperatorRoster } from './operator-roster.ts';
import { RobotRevocations, type RobotRevocationsOptions } from './robot-revocations.ts';

/** The parts of an operator's session that {@link RobotAccess} uses. */
export interface GuardedOperator {
  readonly messages: {
    readonly id: string;
    /** What it may do. */
    access: Access;
    readonly operatorName: string;
    /** When a message last came from it, ms on the robot's clock. */
    readonly heardMs: number;
    send(message: RobotSessionMessage): void;
  };
  readonly peer: Pick<OperatorPeer, 'connected' | 'close'>;
}

export interface RobotAccessOptions extends Omit<GrantGateOptions, 'keys' | 'refusal'> {
  files: Omit<GrantFiles, 'keys' | 'journal'> & {
    keys: Pick<GrantKeysFile, 'keys' | 'reload'>;
    journal: RobotRevocationsOptions['journal'];
  };
  /** What became of each list of revoked grants. */
  revocationLists: ReasonCounts;
  /** For the audit log. */
  onRefused?: (operator: GuardedOperator['messages'], reason: string) => void;
  /** Knows the operators' numbers; without one, there is one of its own. */
  roster?: OperatorRoster;
}

/** Admits operators by their grants, ends their sessions with them, and tells operators of each other. */
export class RobotAccess {
  readonly revocations: RobotRevocations;
  readonly #options: RobotAccessOptions;
  readonly #gate: GrantGate;
  readonly #roster: OperatorRoster;
  readonly #lists: readonly WatchedText[];
  /** What was last read of each. */
  readonly #listed = new Map<string, string>();
  readonly #warned = new WeakSet<GuardedOperator>();
  /** For each supervisor. */
  readonly #endings = new WeakMap<GuardedOperator, TokenBucket>();

  constructor(options: RobotAccessOptions) {
    this.#options = options;
    this.#roster = options.roster ?? new OperatorRoster();
    const { files, revocationLists: outcomes, log, nowS, now } = options;
    const keys = () => files.keys.keys;
    this.revocations = new RobotRevocations({ keys, journal: files.journal, outcomes, log, nowS, now });
    this.#gate = new GrantGate({ ...options, keys, refusal: (grant) => this.revocations.refusal(grant) });
    this.#lists = files.revocations.map(
      (path) =>
        new WatchedText({
          path,
          // And a line's end.
          maxBytes: MAX_REVOCATIONS_LENGTH + 2,
          onText: (text) => {
            this.#listed.set(path, text.trim());
            void this.revocations.take(text.trim(), path);
          },
          onFault: (detail) =>
            log.warn({ detail }, 'revoked grants cannot be read: what was read before counts'),
        }),
    );
    for (const list of this.#lists) void list.start();
  }

  /** A session's first offer is about to be sent. */
  offered({ messages }: GuardedOperator, offer: string): void {
    messages.access = noAccess(messages.operatorName);
    this.#gate.offered(messages.id, offer);
  }

  /** The session has ended. */
  forget(session: string): void {
    this.#gate.forget(session);
  }

  /** Ends the session of an operator that is refused. @returns whether its answer may be used */
  async admits(operator: GuardedOperator, request: AdmissionRequest): Promise<boolean> {
    const judged = await this.#gate.judge(request);
    if (judged.verdict === 'refused') {
      this.#options.onRefused?.(operator.messages, judged.reason);
      operator.peer.close('not-granted', judged.detail);
    }
    if (judged.verdict !== 'admitted') return judged.verdict === 'ready';
    const { access } = judged;
    operator.messages.access = access;
    const { subject, name, role, keyId } = access;
    const session = shortHash('session', request.session);
    const grant = access.grant?.id;
    this.#options.log.info({ session, subject, name, role, keyId, grant }, 'operator admitted');
    return true;
  }

  /**
   * Warns operators whose grants end soon, ends the sessions of those whose grants have ended or were revoked, and tells
   * everybody who is here.
   *
   * @param driver the session that holds the lease
   */
  enforce(operators: ReadonlyMap<string, GuardedOperator>, driver: string | null): void {
    const nowS = this.#options.nowS();
    for (const operator of operators.values()) {
      const { messages, peer } = operator;
      const { grant, expiresAtS } = messages.access;
      if (grant === null) continue;
      const leftS = expiresAtS - nowS;
      const refusal = this.revocations.refusal(grant);
      if (leftS <= 0) peer.close('grant-expired', 'the grant has expired');
      else if (refusal === 'grant-revoked') peer.close('grant-revoked', 'the grant has been revoked');
      else if (refusal !== null) peer.close('ended-by-supervisor', 'a supervisor has blocked the grant');
      else if (leftS <= GRANT_ENDS_SOON_S && peer.connected && !this.#warned.has(operator)) {
        this.#warned.add(operator);
        messages.send({ type: 'expires', inS: Math.floor(leftS) });
      }
    }
    this.#roster.sendDue(operators.values(), driver, this.#options.now());
  }

  /** A supervisor ends another operator's session. What is not done, it is told. */
  endSession(by: GuardedOperator, request: EndSession, operators: Iterable<GuardedOperator>): void {
    const fault = this.#end(by, request, operators);
    if (fault === null) return;
    const [reason, message] = fault;
    by.messages.send({ type: 'fault', message, reason });
  }

  /**
   * Reads the files again, and ends the sessions whose grants were signed by a key that is no longer there. If the keys'
   * file is at fault, the old keys stay in force. @throws {GrantKeysError}
   */
  async reload(operators: () => Iterable<GuardedOperator>): Promise<void> {
    const { files, log } = this.#options;
    for (const list of this.#lists) void list.check();
    await files.keys.reload();
    log.info({ keys: [...files.keys.keys.keys()] }, 'read the keys for grants again');
    for (const { messages, peer } of [...operators()]) {
      const { keyId } = messages.access;
      if (keyId !== null && !files.keys.keys.has(keyId)) {
        peer.close('not-granted', 'the key that signed the grant is no longer accepted');
      }
    }
    await this.revocations.keysChanged();
    for (const [path, text] of this.#listed) await this.revocations.take(text, path);
  }

  close(): void {
    for (const list of this.#lists) list.close();
  }

  #end(
    by: GuardedOperator,
    { operator: number, block }: EndSession,
    operators: Iterable<GuardedOperator>,
  ): [FaultReason, string] | null {
    const bucket = this.#endings.get(by) ?? new TokenBucket({ perSecond: 1, burst: 5 });
    this.#endings.set(by, bucket);
    if (!bucket.take(this.#options.now()))
      return ['rate-limited', 'sessions are ended one a second: wait a moment'];
    if (number === this.#roster.numberOf(by))
      return ['own-session', 'this is your own session: leave it instead'];
    const other = [...operators].find((each) => this.#roster.has(each, number));
    const grant = other?.messages.access.grant ?? null;
    if (other === undefined || grant === null)
      return ['unknown-operator', `no operator has the number ${number} any more`];
    const { name, expiresAtS } = other.messages.access;
    const facts = { session: other.messages.id, subject: grant.subject, name, grant: grant.id };
    const supervisor = by.messages.access;
    if (block && !this.revocations.block(grant, expiresAtS))
      return ['no-room', 'the robot keeps no more blocked grants: have this one revoked'];
    this.#options.log.warn(
      { ...facts, by: supervisor.subject, supervisor: supervisor.name, block },
      'a supervisor ended a session',
    );
    const and = block ? ' and blocked the grant' : '';
    other.peer.close('ended-by-supervisor', `${supervisor.name} ended the session${and}`);
    return null;
  }
}
