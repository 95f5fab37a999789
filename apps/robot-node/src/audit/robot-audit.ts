import { type Audit, type AuditSubject, shortHash } from '@farpoint/audit';
import type { EstopState } from '@farpoint/protocol';
import type { Access } from '../access/access.ts';

/** What an entry says about an operator. */
export interface AuditedOperator {
  /** The session's handle. */
  readonly id: string;
  readonly access: Access;
}

/** What was refused. */
export type RefusedThing = 'admission' | 'session' | 'lease' | 'estop-release' | 'command';

/** Why the driver may have changed, if not by a request. */
export type LeaseCause = 'expired' | 'session-ended';

interface Who {
  readonly subject: AuditSubject;
  readonly session: string;
}

/** Operators of the reference system, who have neither names nor grants. */
const REFERENCE: AuditSubject = { name: 'an operator of the reference system', proven: false };

/** Writes what happens on the robot to its audit log. */
export class RobotAudit {
  readonly #log: Audit;
  readonly #began = new Set<string>();
  #driver: ({ readonly id: string } & Who) | null = null;

  constructor(log: Audit) {
    this.#log = log;
  }

  sessionBegan(operator: AuditedOperator): void {
    this.#began.add(operator.id);
    const { keyId, expiresAtS } = operator.access;
    const grant = keyId === null ? {} : { keyId, expiresAtS };
    this.#log.record({ kind: 'session-began', ...whoIs(operator), details: grant });
  }

  /** Sessions that never began are not recorded. */
  sessionEnded(operator: AuditedOperator, reason: string, detail: string): void {
    if (!this.#began.delete(operator.id)) return;
    this.#log.record({ kind: 'session-ended', ...whoIs(operator), details: { reason, detail } });
  }

  /**
   * Call this whenever the driver may have changed.
   *
   * @param id of the lease's holder, if there is one
   * @param operator the holder, if it is known by a session
   */
  driver(id: string | null, operator: AuditedOperator | undefined, cause?: LeaseCause): void {
    const before = this.#driver;
    if (id === (before?.id ?? null)) return;
    if (id === null) {
      this.#driver = null;
      if (before === null) return;
      const { subject, session } = before;
      const kind = cause === 'expired' ? 'lease-expired' : 'lease-released';
      this.#log.record({ kind, subject, session, details: { because: cause ?? 'asked' } });
      return;
    }
    const who =
      operator === undefined ? { subject: REFERENCE, session: shortHash('session', id) } : whoIs(operator);
    this.#driver = { id, ...who };
    if (before === null) this.#log.record({ kind: 'lease-given', ...who });
    else {
      const from = { ...before.subject, session: before.session };
      this.#log.record({ kind: 'lease-taken', ...who, details: { from } });
    }
  }

  /** @param operator who latched or released it; undefined: the robot itself */
  estop({ latched, by }: EstopState, operator: AuditedOperator | undefined): void {
    const who = operator === undefined ? {} : whoIs(operator);
    this.#log.record({ kind: latched ? 'estop-latched' : 'estop-released', ...who, details: { by } });
  }

  /** The emergency stop outlives the last run. */
  startsLatched(reason: string): void {
    this.#log.record({ kind: 'estop-latched', details: { by: 'robot', atStart: reason } });
  }

  /** @param operator if it is not admitted, its name is only a claim */
  refused(what: RefusedThing, reason: string, operator?: AuditedOperator): void {
    const who = operator === undefined ? {} : whoIs(operator);
    this.#log.record({ kind: 'refused', ...who, details: { what, reason } });
  }
}

function whoIs({ id, access }: AuditedOperator): Who {
  const { subject, name, role, grantId } = access;
  return {
    session: shortHash('session', id),
    subject:
      subject === null
        ? { name, proven: false }
        : { id: subject, name, role: role ?? undefined, grant: grantId ?? undefined, proven: true },
  };
}
