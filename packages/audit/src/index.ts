export { type AuditCommandRim, auditCommand } from './audit-command.ts';
export { type AuditEntry, readEntry, shortHash } from './audit-entry.ts';
export type { AuditEvent, AuditKind, AuditSubject } from './audit-event.ts';
export { AuditFileError } from './audit-file.ts';
export { type Audit, AuditLog, type AuditLogOptions, type Damage, noAudit } from './audit-log.ts';
export type { JsonValue } from './canonical-json.ts';
export * from './chain-verifier.ts';
export { verifyFiles } from './verify-files.ts';
