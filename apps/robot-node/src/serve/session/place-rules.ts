/** Who gets a place of a robot that admits by grants, and who gives way. Without state and clock. */
import type { Role } from '@farpoint/protocol';

/** A place that a session holds. */
export interface HeldPlace {
  readonly session: string;
  /** Whoever the grant is for. */
  readonly holder: string;
  readonly role: Role;
  /** Whether it holds the lease. */
  readonly drives: boolean;
  /** Whether nothing has been heard from it for a while. */
  readonly quiet: boolean;
  /** When it last drove, or else when it was admitted, ms. */
  readonly activeMs: number;
}

export interface PlaceRules {
  /** The maximum number of operators. */
  readonly most: number;
  /** The maximum number of operators with grants for the same subject. */
  readonly perSubject: number;
}

export interface PlaceAsker {
  readonly holder: string;
  readonly role: Role;
}

export type PlaceVerdict =
  | { readonly kind: 'free' }
  /** `session` ends. `why`: its own holder is back, or a higher role needs the place. */
  | { readonly kind: 'instead-of'; readonly session: string; readonly why: 'replaced' | 'displaced' }
  | { readonly kind: 'refused'; readonly why: 'robot-full' | 'subject-full' };

const RANK: Readonly<Record<Role, number>> = { watch: 0, drive: 1, supervise: 2 };

/** As many as one subject may have: never all places, unless there is only one. */
export function mostOfSubject({ most, perSubject }: PlaceRules): number {
  return Math.max(1, Math.min(perSubject, most - 1));
}

/**
 * @param held of all operators that were admitted
 * @param keptFor whose place is kept; `null` if none is
 */
export function judgePlace(
  held: readonly HeldPlace[],
  keptFor: string | null,
  asker: PlaceAsker,
  rules: PlaceRules,
): PlaceVerdict {
  const own = held.filter(({ holder }) => holder === asker.holder);
  const supervises = asker.role === 'supervise';
  // Somebody who supervises needs no place kept for anybody.
  const kept = keptFor === null || keptFor === asker.holder || supervises ? 0 : 1;
  const full = held.length + kept >= rules.most;
  if (own.length >= mostOfSubject(rules) || full) {
    // A page that was reloaded, or a browser that was killed.
    const gone = longestIdle(own.filter(({ quiet }) => quiet));
    if (gone !== undefined) return { kind: 'instead-of', session: gone.session, why: 'replaced' };
  }
  if (own.length >= mostOfSubject(rules)) return { kind: 'refused', why: 'subject-full' };
  if (!full) return { kind: 'free' };
  const lower = held.filter(({ role }) => RANK[role] < RANK[asker.role]);
  const idle = lower.filter(({ drives }) => !drives);
  const least = Math.min(...idle.map(({ role }) => RANK[role]));
  // Whoever drives gives way last, and only to somebody who could end the session anyway.
  const next =
    longestIdle(idle.filter(({ role }) => RANK[role] === least)) ?? (supervises ? lower[0] : undefined);
  if (next === undefined) return { kind: 'refused', why: 'robot-full' };
  return { kind: 'instead-of', session: next.session, why: 'displaced' };
}

/** Those that are not heard come before all others. */
function longestIdle(places: readonly HeldPlace[]): HeldPlace | undefined {
  return [...places].sort((a, b) => Number(b.quiet) - Number(a.quiet) || a.activeMs - b.activeMs)[0];
}
