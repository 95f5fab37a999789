/** What an operator shows to robots that ask for grants. */
import { coversRobot, decodeTicket, GrantRefusedError, importOperatorKey, readGrant } from '@farpoint/grants';
import type { Role } from '@farpoint/protocol';
import { keyThumbprint, type OperatorKey } from './operator-key.ts';

/** What a grant says (docs/protocol.md). */
export interface GrantClaims {
  /** Who issued it. */
  iss: string;
  /** To whom. Stays the same when a person gets another grant or another key. */
  sub: string;
  /** The person's name, for people. */
  name: string;
  /** `farpoint`, or a list that contains it. */
  aud: string | string[];
  /** When it was issued, seconds since 1970. */
  iat: number;
  /** From when it is valid, seconds since 1970. */
  nbf: number;
  /** When it ends, seconds since 1970. */
  exp: number;
  /** Names this grant. */
  jti: string;
  /** Robot ids, in which each `*` stands for any characters or none. */
  robots: string[];
  /** What it allows. */
  role: Role;
  /** The operator's own key. */
  cnf: {
    /** Its thumbprint. */
    jkt: string;
  };
  /** Thumbprints of robots' keys, by robot id. */
  robotKeys?: Record<string, string> | undefined;
}

/** A grant of the operator, and the key that it names. */
export interface OperatorCredentials {
  /** In its compact form, as the issuer wrote it. */
  readonly grant: string;
  /** The operator's own key. Its private part is never sent, and need not be extractable. */
  readonly key: OperatorKey;
}

/** Credentials, and what their grant says. Whether it is valid is for the robot to say. */
export interface ChosenGrant extends OperatorCredentials {
  readonly claims: GrantClaims;
}

/** @returns `null` if it is not a grant */
export function claimsOfGrant(text: string): GrantClaims | null {
  try {
    return readGrant(text).claims;
  } catch (error) {
    if (error instanceof GrantRefusedError) return null;
    throw error;
  }
}

/**
 * What to show to a robot: a grant that covers it; if possible one that is valid now, and among those the one that
 * allows most and lasts longest.
 *
 * @param nowS seconds since 1970
 * @returns `null` if no grant covers the robot
 */
export async function grantFor(
  credentials: readonly OperatorCredentials[],
  robotId: string,
  nowS: number,
): Promise<ChosenGrant | null> {
  let best: { chosen: ChosenGrant; rank: readonly number[] } | null = null;
  for (const { grant, key } of credentials) {
    const claims = claimsOfGrant(grant);
    if (claims === null || !coversRobot(claims.robots, robotId)) continue;
    if (claims.cnf.jkt !== (await keyThumbprint(key.publicJwk))) continue;
    const isValid = claims.exp > nowS && claims.nbf <= nowS;
    const rank = [Number(isValid), ROLE_RANK[claims.role], claims.exp];
    if (best === null || isHigher(rank, best.rank)) best = { chosen: { grant, key, claims }, rank };
  }
  return best?.chosen ?? null;
}

const ROLE_RANK = { watch: 0, drive: 1, supervise: 2 } as const;

function isHigher(rank: readonly number[], than: readonly number[]): boolean {
  const at = rank.findIndex((each, i) => each !== than[i]);
  return at >= 0 && (rank[at] ?? 0) > (than[at] ?? 0);
}

/**
 * Reads a ticket, the line that holds both a grant and its key.
 *
 * @returns `null` if it is not a ticket, or if its key is not the one that its grant names
 */
export async function readTicket(text: string): Promise<OperatorCredentials | null> {
  const ticket = decodeTicket(text.trim());
  const claims = ticket === null ? null : claimsOfGrant(ticket.grant);
  if (ticket === null || claims === null) return null;
  try {
    const key = await importOperatorKey(ticket.key);
    return (await keyThumbprint(key.publicJwk)) === claims.cnf.jkt ? { grant: ticket.grant, key } : null;
  } catch {
    return null;
  }
}
