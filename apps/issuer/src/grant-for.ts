/** The grant that a person gets. */
import { AUDIENCE, coversRobot, type GrantClaims, grantClaimsSchema } from '@farpoint/grants';
import type { Person } from './person.ts';
import type { Rule } from './rules.ts';

export interface GrantTerms {
  /** Who issues it. */
  issuer: string;
  /** How long it is valid. */
  hours: number;
  /** Thumbprints of robots' keys, by robot id. */
  robotKeys: Readonly<Record<string, string>>;
}

/**
 * @param key thumbprint of the operator's own key
 * @param id names the grant
 * @param nowS seconds since 1970
 */
export function grantFor(
  { subject, name }: Person,
  { role, robots }: Pick<Rule, 'role' | 'robots'>,
  { issuer, hours, robotKeys }: GrantTerms,
  { key, id, nowS }: { key: string; id: string; nowS: number },
): GrantClaims {
  const known = Object.entries(robotKeys).filter(([robot]) => coversRobot(robots, robot));
  const from = Math.floor(nowS);
  return grantClaimsSchema.parse({
    iss: issuer,
    sub: subject,
    name,
    aud: AUDIENCE,
    role,
    robots,
    cnf: { jkt: key },
    jti: id,
    iat: from,
    nbf: from,
    exp: from + Math.round(hours * 3600),
    ...(known.length === 0 ? {} : { robotKeys: Object.fromEntries(known) }),
  });
}
