import type { RevocationsPayload } from './revocations.ts';

/** What is to be revoked. */
export interface NewRevocations {
  /** Ids of single grants. */
  ids: readonly string[];
  /** Persons: their grants that were issued until now. */
  subjects: readonly string[];
  /** When the last of these grants ends, seconds since 1970. */
  expiresAtS: number;
}

/**
 * The list that comes after another, without the entries that mean nothing any more.
 *
 * @param earlier `null` for the first one
 * @param nowS seconds since 1970
 */
export function extendRevocations(
  earlier: RevocationsPayload | null,
  { ids, subjects, expiresAtS }: NewRevocations,
  issuer: string,
  nowS: number,
): RevocationsPayload {
  const iat = Math.floor(nowS);
  const grants = new Map<string, number>();
  const persons = new Map<string, { before: number; exp: number }>();
  const addGrant = (jti: string, exp: number) => grants.set(jti, Math.max(exp, grants.get(jti) ?? 0));
  const addPerson = (sub: string, before: number, exp: number) => {
    const known = persons.get(sub) ?? { before: 0, exp: 0 };
    persons.set(sub, { before: Math.max(before, known.before), exp: Math.max(exp, known.exp) });
  };
  for (const { jti, exp } of earlier?.grants ?? []) if (exp > nowS) addGrant(jti, exp);
  for (const { sub, before, exp } of earlier?.subjects ?? []) if (exp > nowS) addPerson(sub, before, exp);
  for (const id of ids) addGrant(id, expiresAtS);
  // A grant that was issued in this very second is revoked, too.
  for (const subject of subjects) addPerson(subject, iat + 1, expiresAtS);
  return {
    iss: issuer,
    iat,
    // By the clock, so that it also rises after the earlier list was lost.
    seq: Math.max((earlier?.seq ?? 0) + 1, iat),
    grants: [...grants].map(([jti, exp]) => ({ jti, exp })),
    subjects: [...persons].map(([sub, { before, exp }]) => ({ sub, before, exp })),
  };
}
