import type { JsonValue } from './canonical-json.ts';

/** Everything that is recorded. A robot and a signaling service each write some of these. */
export const auditKinds = [
  'started',
  'stopped',
  'reloaded', // keys, tokens or a certificate were read again
  'connected', // signaling: a robot or an operator, with the token that it used
  'disconnected',
  'session-began',
  'session-ended',
  'lease-given',
  'lease-taken', // from another operator, who is in the details
  'lease-handed-over', // by another operator, who is in the details
  'lease-released',
  'lease-expired', // the driver was silent for too long
  'estop-latched',
  'estop-released',
  'return-began', // a robot without operators drives back by itself
  'return-ended', // with the reason; perhaps before it has begun
  'command-began', // a robot command, a recording or a bookmark, as named in the details
  'command-ended',
  'refused',
  // About the log itself:
  'torn-entry', // the program ended while it wrote; the bytes before this entry are what it left
  'log-set-aside', // the file was no audit log, or too damaged to be continued
  'entries-omitted', // more of a kind than may be written
  'entries-dropped', // the disk did not keep up or was full
] as const;

export type AuditKind = (typeof auditKinds)[number];

/** Who did it. */
export interface AuditSubject {
  /** The grant's subject; absent without a grant. */
  readonly id?: string | undefined;
  /** By the grant, or else what the operator calls itself. */
  readonly name: string;
  readonly role?: string | undefined;
  /** Names the grant (its `jti`). */
  readonly grant?: string | undefined;
  /** Whether a grant proves it. If not, the name is only a claim. */
  readonly proven: boolean;
}

export interface AuditEvent {
  readonly kind: AuditKind;
  readonly subject?: AuditSubject | undefined;
  /** The session's short hash, never its handle. */
  readonly session?: string | undefined;
  /** The robot's id, if it is not the one that writes the log. */
  readonly robot?: string | undefined;
  readonly details?: { readonly [key: string]: JsonValue | undefined } | undefined;
}
