import { type Audit, type AuditEvent, shortHash } from '@farpoint/audit';
import type { Observer, RejectReason } from './observer.ts';

/** Refusals that say something about who tried what. The others are faults in messages, which metrics count. */
const AUDITED: ReadonlySet<RejectReason> = new Set([
  'unauthorized',
  'robot-id-taken',
  'not-yours',
  'full',
  'origin',
  'host',
  'too-many-connections',
  'too-many-connections-per-address',
  'too-many-faults',
  'too-many-sessions',
  'wrong-resume-key',
  'slow-consumer',
]);

/** Writes the service's events to the audit log, besides telling the other observer. */
export function auditObserver(audit: Audit, inner: Observer): Observer {
  const record = (event: AuditEvent) => audit.record(event);
  return {
    robotJoined(role, id, address, tookOver, token) {
      const details = { as: role, address, tookOver, token: tokenName(token) };
      record({ kind: 'connected', robot: String(id), details });
      inner.robotJoined(role, id, address, tookOver, token);
    },
    robotLeft(role, id) {
      record({ kind: 'disconnected', robot: String(id), details: { as: role } });
      inner.robotLeft(role, id);
    },
    operatorJoined(name, address, token) {
      const details = { as: 'operator', address, token: tokenName(token) };
      record({ kind: 'connected', subject: { name, proven: false }, details });
      inner.operatorJoined(name, address, token);
    },
    operatorLeft(name) {
      record({ kind: 'disconnected', subject: { name, proven: false }, details: { as: 'operator' } });
      inner.operatorLeft(name);
    },
    sessionOpened(session, robot, operator) {
      const subject = { name: operator, proven: false };
      record({ kind: 'session-began', session: shortHash('session', session), robot, subject });
      inner.sessionOpened(session, robot, operator);
    },
    sessionClosed(session, reason) {
      record({ kind: 'session-ended', session: shortHash('session', session), details: { reason } });
      inner.sessionClosed(session, reason);
    },
    relayed: (type, ms) => inner.relayed(type, ms),
    rejected(role, reason, detail) {
      if (AUDITED.has(reason)) record({ kind: 'refused', details: { what: role, reason, detail } });
      inner.rejected(role, reason, detail);
    },
  };
}

function tokenName(token: string | undefined): string | undefined {
  return token === undefined ? undefined : shortHash('token', token);
}
