import { shortHash } from '@farpoint/audit';
import {
  type AdmissionRequest,
  admit,
  type GrantKeys,
  type GrantRefusal,
  GrantRefusedError,
  type RevocableGrant,
  refusalText,
} from '@farpoint/grants';
import type { Logger } from '@farpoint/service';
import { LimitedLines } from '../../ground/limited-lines.ts';
import type { ReasonCounts } from '../../ground/robot-counters.ts';
import type { Access } from './access.ts';

export interface GrantGateOptions {
  /** The keys whose grants count now. */
  keys: () => GrantKeys;
  /** Why a grant that is valid by itself is not taken; `null` if it is. */
  refusal: (grant: RevocableGrant) => GrantRefusal | null;
  /** This robot's id. */
  robot: string;
  refusals: ReasonCounts;
  log: Logger;
  /** Seconds since 1970. */
  nowS: () => number;
  /** A monotonic clock, ms. */
  now: () => number;
}

/**
 * - `ready`: this answer may be used; the operator was admitted by it or by an earlier one.
 * - `busy`: an earlier answer is still being verified.
 */
export type GateVerdict =
  | { verdict: 'ready' | 'busy' }
  | { verdict: 'admitted'; access: Access }
  /** `detail` is for the operator. */
  | { verdict: 'refused'; reason: GrantRefusedError['reason']; detail: string };

interface Entry {
  offer: string;
  state: 'waiting' | 'verifying' | 'admitted';
}

/** Admits operators to sessions by their grants and proofs, before anything else of their answers is looked at. */
export class GrantGate {
  readonly #options: GrantGateOptions;
  readonly #sessions = new Map<string, Entry>();
  /** A stranger must not be able to fill the log. */
  readonly #reports = new LimitedLines();

  constructor(options: GrantGateOptions) {
    this.#options = options;
  }

  /** A session's first offer is about to be sent. */
  offered(session: string, offer: string): void {
    this.#sessions.set(session, { offer, state: 'waiting' });
  }

  /** The session has ended. */
  forget(session: string): void {
    this.#sessions.delete(session);
  }

  async judge(request: AdmissionRequest): Promise<GateVerdict> {
    const entry = this.#sessions.get(request.session);
    // Without an offer, there is nothing to answer.
    if (entry === undefined || entry.state === 'verifying') return { verdict: 'busy' };
    if (entry.state === 'admitted') return { verdict: 'ready' };
    entry.state = 'verifying';
    const { keys, refusal, robot, log, nowS } = this.#options;
    try {
      const grant = await admit(request, { keys: keys(), robot, offer: entry.offer, nowS: nowS() });
      // The keys may have been read again in the meantime.
      if (!keys().has(grant.keyId))
        throw new GrantRefusedError('grant-untrusted', 'its key has just been removed');
      const refused = refusal(grant);
      if (refused !== null) throw new GrantRefusedError(refused, `grant ${grant.id} of ${grant.subject}`);
      entry.state = 'admitted';
      const { subject, name, role, expiresAtS, keyId } = grant;
      return { verdict: 'admitted', access: { subject, name, role, expiresAtS, keyId, grant } };
    } catch (error) {
      // The entry stays as it is: a session whose answer was refused gets no second try.
      if (error instanceof GrantRefusedError) return this.#refuse(request.session, error);
      log.error({ err: error }, 'a grant could not be verified');
      return this.#refuse(request.session, new GrantRefusedError('grant-malformed', 'cannot be verified'));
    }
  }

  #refuse(session: string, { reason, message }: GrantRefusedError): GateVerdict {
    const { refusals, log, now } = this.#options;
    refusals.add(reason);
    const unreported = this.#reports.take(now());
    if (unreported !== null) {
      log.warn(
        { session: shortHash('session', session), reason, detail: message, unreported },
        'operator not admitted',
      );
    }
    return { verdict: 'refused', reason, detail: refusalText(reason) };
  }
}
