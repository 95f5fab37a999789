import { type Audit, type AuditEvent, type AuditSubject, noAudit, shortHash } from '@farpoint/audit';
import type { CommandState, EstopState, ReturnEnd, RobotStop } from '@farpoint/protocol';
import type { RobotStopState } from '@farpoint/safety';
import type { Access } from '../access/access.ts';

/** What an entry says about an operator. */
export interface AuditedOperator {
  /** The session's handle. */
  readonly id: string;
  readonly access: Access;
}

/** What was refused. */
export type RefusedThing = 'admission' | 'session' | 'lease' | 'estop-release' | 'command' | 'robot-command';

/** Why the driver may have changed, if not by a request. */
export type LeaseCause = 'expired' | 'session-ended' | 'handed-over';

interface Who {
  readonly subject: AuditSubject;
  readonly session: string;
}

/** Operators of the reference system, who have neither names nor grants. */
const REFERENCE: AuditSubject = { name: 'an operator of the reference system', proven: false };

/** Writes what happens on the robot to its audit log. */
export class RobotAudit {
  readonly #logs: Audit[] = [];
  readonly #began = new Set<string>();
  #driver: ({ readonly id: string } & Who) | null = null;

  constructor(log: Audit) {
    this.alsoTell(log);
  }

  /** Another place where everything is recorded from now on. */
  alsoTell(log: Audit): void {
    if (log !== noAudit) this.#logs.push(log);
  }

  sessionBegan(operator: AuditedOperator): void {
    this.#began.add(operator.id);
    const { keyId, expiresAtS } = operator.access;
    const grant = keyId === null ? {} : { keyId, expiresAtS };
    this.#record({ kind: 'session-began', ...whoIs(operator), details: grant });
  }

  /** Sessions that never began are not recorded. */
  sessionEnded(operator: AuditedOperator, reason: string, detail: string): void {
    if (!this.#began.delete(operator.id)) return;
    this.#record({ kind: 'session-ended', ...whoIs(operator), details: { reason, detail } });
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
      this.#record({ kind, subject, session, details: { because: cause ?? 'asked' } });
      return;
    }
    const who =
      operator === undefined ? { subject: REFERENCE, session: shortHash('session', id) } : whoIs(operator);
    this.#driver = { id, ...who };
    if (before === null) this.#record({ kind: 'lease-given', ...who });
    else {
      const from = { ...before.subject, session: before.session };
      const kind = cause === 'handed-over' ? 'lease-handed-over' : 'lease-taken';
      this.#record({ kind, ...who, details: { from } });
    }
  }

  /** @param operator who latched or released it; undefined: the robot itself */
  estop({ latched, by }: EstopState, operator: AuditedOperator | undefined): void {
    const who = operator === undefined ? {} : whoIs(operator);
    this.#record({ kind: latched ? 'estop-latched' : 'estop-released', ...who, details: { by } });
  }

  /**
   * A stop at the robot itself holds the emergency stop, or no longer.
   *
   * @param said what it says
   * @param latched whether the emergency stop is latched still
   */
  robotStop(stop: RobotStop, said: RobotStopState, { latched }: EstopState): void {
    if (said !== 'go') this.#record({ kind: 'estop-latched', details: { by: 'robot', stop, said } });
    else if (!latched) this.#record({ kind: 'estop-released', details: { by: 'robot', stop } });
  }

  /** Somebody at the robot has released the emergency stop. */
  releasedAtRobot(): void {
    this.#record({ kind: 'estop-released', details: { by: 'somebody at the robot' } });
  }

  /** The robot drives back by itself, or no longer. @param end why no longer; `null`: it begins */
  returned(end: ReturnEnd | null, metres: number): void {
    if (end === null) this.#record({ kind: 'return-began' });
    else this.#record({ kind: 'return-ended', details: { because: end, metres } });
  }

  /** The emergency stop outlives the last run. */
  startsLatched(reason: string): void {
    this.#record({ kind: 'estop-latched', details: { by: 'robot', atStart: reason } });
  }

  /**
   * A command that an operator gave was begun, or has ended.
   *
   * @param run names it
   * @param state `running` at its beginning
   * @param text of a bookmark, or what the robot's own program says of its end
   */
  command(operator: AuditedOperator, run: number, id: string, state: CommandState, text: string): void {
    const kind = state === 'running' ? 'command-began' : 'command-ended';
    const said = text === '' ? {} : { text };
    const ended = state === 'running' ? {} : { state };
    this.#record({ kind, ...whoIs(operator), details: { command: id, run, ...ended, ...said } });
  }

  /** @param operator if it is not admitted, its name is only a claim */
  refused(what: RefusedThing, reason: string, operator?: AuditedOperator): void {
    // Somebody who may only watch can send commands as often as a driver.
    if (this.#logs.length === 0) return;
    const who = operator === undefined ? {} : whoIs(operator);
    this.#record({ kind: 'refused', ...who, details: { what, reason } });
  }

  #record(event: AuditEvent): void {
    for (const log of this.#logs) log.record(event);
  }
}

function whoIs({ id, access }: AuditedOperator): Who {
  const { subject, name, role, grant } = access;
  return {
    session: shortHash('session', id),
    subject:
      subject === null
        ? { name, proven: false }
        : { id: subject, name, role: role ?? undefined, grant: grant?.id, proven: true },
  };
}
