import type { RevocableGrant, RevocationsPayload } from './revocations.ts';

/** All that still counts of the lists of one key. */
export type RevocationEntries = Pick<RevocationsPayload, 'grants' | 'subjects'>;

/** Entries of each kind that are kept for one key: several times as many as one list has. */
export const MAX_KNOWN_REVOCATIONS = 8192;

interface SubjectEntry {
  readonly before: number;
  readonly exp: number;
}

/** How a list changed what is known. */
export interface RevocationsChange {
  /** Entries that were not known. */
  readonly added: number;
  /** Known entries that still count and that the list leaves out, although it is the newest. */
  readonly missing: number;
  /** Entries that were given up, because there is no room for more. */
  readonly dropped: number;
}

/**
 * What one key has revoked: the union of its lists. Each entry counts until it ends, whichever list comes later and in
 * whatever order they come, so that no list gives back what another has taken. Ready to be asked about each operator many
 * times a second.
 */
export class KnownRevocations {
  readonly keyId: string;
  #sequence: number;
  readonly #grants = new Map<string, number>();
  readonly #subjects = new Map<string, readonly SubjectEntry[]>();

  constructor(keyId: string, sequence = 0) {
    this.keyId = keyId;
    this.#sequence = sequence;
  }

  /** Of the newest list. */
  get sequence(): number {
    return this.#sequence;
  }

  /** @param nowS seconds since 1970 */
  add(list: RevocationEntries & { readonly seq: number }, nowS: number): RevocationsChange {
    this.#forget(nowS);
    const missing = list.seq > this.#sequence ? missingFrom(this.entries(nowS), list, nowS) : 0;
    this.#sequence = Math.max(this.#sequence, list.seq);
    let added = 0;
    for (const { jti, exp } of list.grants) {
      if (exp <= nowS || exp <= (this.#grants.get(jti) ?? 0)) continue;
      this.#grants.set(jti, exp);
      added++;
    }
    for (const { sub, before, exp } of list.subjects) {
      const known = this.#subjects.get(sub) ?? [];
      if (exp <= nowS || known.some((each) => covers(each, { before, exp }))) continue;
      this.#subjects.set(sub, [...known.filter((each) => !covers({ before, exp }, each)), { before, exp }]);
      added++;
    }
    return { added, missing, dropped: this.#makeRoom() };
  }

  /** @param nowS seconds since 1970 */
  revokes({ id, subject, keyId, issuedAtS }: RevocableGrant, nowS: number): boolean {
    if (keyId !== this.keyId) return false;
    if ((this.#grants.get(id) ?? 0) > nowS) return true;
    return this.#subjects.get(subject)?.some(({ before, exp }) => issuedAtS < before && exp > nowS) ?? false;
  }

  /** What still counts. */
  entries(nowS: number): RevocationEntries {
    const grants = [...this.#grants].map(([jti, exp]) => ({ jti, exp }));
    const subjects = [...this.#subjects].flatMap(([sub, each]) => each.map((entry) => ({ sub, ...entry })));
    return {
      grants: grants.filter(({ exp }) => exp > nowS),
      subjects: subjects.filter(({ exp }) => exp > nowS),
    };
  }

  #forget(nowS: number): void {
    for (const [id, exp] of this.#grants) if (exp <= nowS) this.#grants.delete(id);
    for (const [subject, entries] of this.#subjects) {
      const left = entries.filter(({ exp }) => exp > nowS);
      if (left.length === 0) this.#subjects.delete(subject);
      else if (left.length < entries.length) this.#subjects.set(subject, left);
    }
  }

  /** Gives up the entries that end first. @returns how many */
  #makeRoom(): number {
    const { grants, subjects } = this.entries(0);
    const goneGrants = endingFirst(grants);
    for (const { jti } of goneGrants) this.#grants.delete(jti);
    const goneSubjects = endingFirst(subjects);
    for (const { sub, before, exp } of goneSubjects) {
      const left = (this.#subjects.get(sub) ?? []).filter(
        (each) => each.before !== before || each.exp !== exp,
      );
      if (left.length === 0) this.#subjects.delete(sub);
      else this.#subjects.set(sub, left);
    }
    return goneGrants.length + goneSubjects.length;
  }
}

/** How many entries of an earlier list still count and are not in a later one. @param nowS seconds since 1970 */
export function missingFrom(earlier: RevocationEntries, later: RevocationEntries, nowS: number): number {
  const grants = new Map(later.grants.map(({ jti, exp }) => [jti, exp]));
  const lost = earlier.grants.filter(({ jti, exp }) => exp > nowS && exp > (grants.get(jti) ?? 0));
  const subjects = new Map<string, SubjectEntry[]>();
  for (const entry of later.subjects) subjects.set(entry.sub, [...(subjects.get(entry.sub) ?? []), entry]);
  const forgiven = earlier.subjects.filter(
    (entry) => entry.exp > nowS && !subjects.get(entry.sub)?.some((each) => covers(each, entry)),
  );
  return lost.length + forgiven.length;
}

function covers(one: SubjectEntry, other: SubjectEntry): boolean {
  return one.before >= other.before && one.exp >= other.exp;
}

function endingFirst<Entry extends { exp: number }>(entries: readonly Entry[]): Entry[] {
  const over = entries.length - MAX_KNOWN_REVOCATIONS;
  return over <= 0 ? [] : [...entries].sort((a, b) => a.exp - b.exp).slice(0, over);
}
