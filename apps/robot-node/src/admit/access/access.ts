import type { RevocableGrant } from '@farpoint/grants';
import type { Role } from '@farpoint/protocol';

/** What one operator may do, and until when. */
export interface Access {
  /** `null` if the robot asks for no grants: then everybody may drive, and the take-over policy binds everybody. */
  readonly role: Role | null;
  /** Stays the same when a person gets another grant; `null` without grants. */
  readonly subject: string | null;
  /** By the grant, or else what the operator calls itself. */
  readonly name: string;
  /** When the grant ends, seconds since 1970; infinite without grants. */
  readonly expiresAtS: number;
  /** The key that signed the grant; `null` without grants. */
  readonly keyId: string | null;
  /** Names the grant, and is what revocations go by; `null` without grants. */
  readonly grant: RevocableGrant | null;
}

/** The access of everybody at a robot that asks for no grants. */
export function openAccess(name: string): Access {
  return { role: null, subject: null, name, expiresAtS: Number.POSITIVE_INFINITY, keyId: null, grant: null };
}

/** Of somebody who has not shown a grant yet. Nothing is sent to it, and nothing that it sends is looked at. */
export function noAccess(name: string): Access {
  return { role: 'watch', subject: null, name, expiresAtS: 0, keyId: null, grant: null };
}

export function mayDrive({ role }: Access): boolean {
  return role !== 'watch';
}

export function supervises({ role }: Access): boolean {
  return role === 'supervise';
}
