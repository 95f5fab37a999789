import { shortHash } from '@farpoint/audit';
import type { AdmissionRequest } from '@farpoint/grants';
import type { OperatorMessages } from '../session/operator-messages.ts';
import type { OperatorPeer } from '../transport/operator-peer.ts';
import { noAccess } from './access.ts';
import { GrantGate, type GrantGateOptions } from './grant-gate.ts';
import type { GrantKeysFile } from './grant-keys-file.ts';

/** How long before the end of its grant an operator is warned, s. */
export const WARNING_S = 60;

/** The parts of an operator's session that {@link RobotAccess} uses. */
export interface GuardedOperator {
  readonly messages: Pick<OperatorMessages, 'id' | 'access' | 'operatorName' | 'send'>;
  readonly peer: Pick<OperatorPeer, 'connected' | 'close'>;
}

export interface RobotAccessOptions extends Omit<GrantGateOptions, 'keys'> {
  file: Pick<GrantKeysFile, 'keys' | 'reload'>;
  /** For the audit log. */
  onRefused?: (operator: GuardedOperator['messages'], reason: string) => void;
}

/** Admits operators by their grants, and ends their sessions with them. */
export class RobotAccess {
  readonly #options: RobotAccessOptions;
  readonly #gate: GrantGate;
  readonly #warned = new WeakSet<GuardedOperator>();

  constructor(options: RobotAccessOptions) {
    this.#options = options;
    this.#gate = new GrantGate({ ...options, keys: () => options.file.keys });
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
    this.#options.log.info({ session, subject, name, role, keyId }, 'operator admitted');
    return true;
  }

  /** Warns operators whose grants end soon, and ends the sessions of those whose grants have. */
  tick(operators: Iterable<GuardedOperator>): void {
    const nowS = this.#options.nowS();
    for (const operator of operators) {
      const { messages, peer } = operator;
      const { keyId, expiresAtS } = messages.access;
      if (keyId === null) continue;
      const leftS = expiresAtS - nowS;
      if (leftS <= 0) peer.close('grant-expired', 'the grant has expired');
      else if (leftS <= WARNING_S && peer.connected && !this.#warned.has(operator)) {
        this.#warned.add(operator);
        messages.send({ type: 'expires', inS: Math.floor(leftS) });
      }
    }
  }

  /**
   * Reads the keys again, and ends the sessions whose grants were signed by a key that is no longer there. If the file
   * is at fault, the old keys stay in force. @throws {GrantKeysError}
   */
  async reload(operators: () => Iterable<GuardedOperator>): Promise<void> {
    const { file, log } = this.#options;
    await file.reload();
    log.info({ keys: [...file.keys.keys()] }, 'read the keys for grants again');
    for (const { messages, peer } of [...operators()]) {
      const { keyId } = messages.access;
      if (keyId !== null && !file.keys.has(keyId)) {
        peer.close('not-granted', 'the key that signed the grant is no longer accepted');
      }
    }
  }
}
